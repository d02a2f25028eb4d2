#pragma once

#include "terrain/ground/tin.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Every post, and two triangles a cell cut from its first to its last corner, as the march over
/// the grid has it (height_field.hpp). A cell with one void corner has one triangle, with more
/// none.
Tin full_grid(const Dem& dem);

}  // namespace diurna
