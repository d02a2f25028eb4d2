#pragma once

#include "scenes/input/scene.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The elevation that a scene stands on: its raster and tiles, the window and the unit it asks for,
/// and on it the finer models of part of it. Throws InputError as read_dem
/// (terrain/raster/read_dem.hpp) and lay_detail (terrain/ground/dem_detail.hpp) do.
Dem elevation_of(const Scene& scene);

}  // namespace diurna
