#pragma once

#include <vector>

#include "scenes/job/input/checked_names.hpp"
#include "scenes/job/input/object_input.hpp"

namespace diurna {

/// The copies of an object, by the keys `copies` or `copies_file`: separate objects "NAME_0001" and
/// so on with a common mesh. Without these keys the object alone.
///
/// They are placed as their places say; a texture, contact with the ground, a trajectory or a
/// `place` is then a mistake of the scene file, and so is a place in the file that is not a number,
/// reported with its line.
std::vector<ObjectInput> with_copies(const Section& section, ObjectInput object, Reading& reading);

}  // namespace diurna
