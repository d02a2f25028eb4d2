#pragma once

#include "materials/base/section.hpp"
#include "scenes/job/input/object_input.hpp"

namespace diurna {

/// The keys `stands`, `pitch_deg` and `roll_deg` of an object whose mesh, placing and height are
/// read; computes its contact points.
///
/// - of_model: whether its model is vertical by default (models.hpp); false for a mesh
void read_stance(const Section& section, bool of_model, ObjectInput& object);

}  // namespace diurna
