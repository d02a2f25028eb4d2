#pragma once

#include <span>
#include <vector>

#include "scenes/world/objects.hpp"

namespace diurna {

/// The ground of copies that shall be fine for their shadows (ground_patch of each), none of it
/// twice: where several ask for it, as tiles of one lattice whose borders fit point by point. Many
/// squares laid over one another would be cut along all their sides and filled by all their
/// lattices.
///
/// - copies: of one object
std::vector<GroundPatch> patches_round(std::span<const ObjectInput> copies);

}  // namespace diurna
