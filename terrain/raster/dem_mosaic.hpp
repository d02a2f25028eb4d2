#pragma once

#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Joins tiles of one lattice; where tiles overlap, the first tile's posts are used. Notes
/// differences of more than a metre. Throws InputError for tiles of another lattice or CRS.
/// CRS.
Dem joined(std::vector<Dem> tiles);

}  // namespace diurna
