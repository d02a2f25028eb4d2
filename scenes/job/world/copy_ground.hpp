#pragma once

#include <span>
#include <vector>

#include "scenes/job/world/objects.hpp"

namespace diurna {

/// The refined ground for the shadows of copies (ground_patch of each), without duplicates:
/// if several need it, as tiles of one lattice whose borders fit point by point. Many
/// overlapping squares would be cut along all their sides and filled with all their
/// lattices.
///
/// - copies: of one object
std::vector<GroundPatch> patches_round(std::span<const ObjectInput> copies);

}  // namespace diurna
