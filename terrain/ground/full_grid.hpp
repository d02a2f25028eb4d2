#pragma once

#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Every post, and two triangles per cell, split from its first to its last corner, as in the march
/// over the grid (height_field.hpp). A cell with one void corner has one triangle, with more voids
/// none.
Tin full_grid(const Dem& dem);

}  // namespace diurna
