#pragma once

#include "materials/base/section.hpp"
#include "scenes/job/input/target_input.hpp"

/// Parts of an object with a single temperature, and connections that carry heat between them.
namespace diurna {

/// - target: the object as read so far: names must differ, ends must be known
EnclosureInput read_enclosure(const Section& section, const TargetInput& target);
LumpInput read_lump(const Section& section, const TargetInput& target);
LinkInput read_link(const Section& section, TargetInput& target);
StreamInput read_stream(const Section& section, const TargetInput& target);

/// Inflow and outflow of each lump and enclosure must be equal, to conserve energy.
void check_streams(const Section& section, const TargetInput& target);

}  // namespace diurna
