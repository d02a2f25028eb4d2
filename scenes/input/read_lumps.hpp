#pragma once

#include "materials/base/section.hpp"
#include "scenes/input/target_input.hpp"

/// What of an object is of one temperature, and what carries heat between such things.
namespace diurna {

/// - target: what has been read of the object before: names must differ, ends must be known
EnclosureInput read_enclosure(const Section& section, const TargetInput& target);
LumpInput read_lump(const Section& section, const TargetInput& target);
LinkInput read_link(const Section& section, TargetInput& target);
StreamInput read_stream(const Section& section, const TargetInput& target);

/// As much must leave each lump and enclosure as enters it, or heat comes of nothing.
void check_streams(const Section& section, const TargetInput& target);

}  // namespace diurna
