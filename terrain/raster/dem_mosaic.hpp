#pragma once

#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// Tiles of one lattice as one raster; of posts that several know, the first tile's. Notes where
/// they differ by more than a metre. Throws InputError for tiles of another lattice or CRS.
Dem joined(std::vector<Dem> tiles);

}  // namespace diurna
