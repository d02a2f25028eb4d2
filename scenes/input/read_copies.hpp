#pragma once

#include <vector>

#include "scenes/input/checked_names.hpp"
#include "scenes/input/object_input.hpp"

namespace diurna {

/// The copies of an object, by the keys `copies` or `copies_file`: each an object of its own,
/// "NAME_0001" and so on, with the mesh of all. Without these keys the object alone.
///
/// They stand where their places say; with a texture, contact with the ground, a trajectory or a
/// place of its own they are a mistake of the scene file, and so is a place of the file that is no
/// number, given by its line.
std::vector<ObjectInput> with_copies(const Section& section, ObjectInput object, Reading& reading);

}  // namespace diurna
