#pragma once

#include "scenes/input/scene.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The elevation that a scene stands on: what its places have read already, or read anew. Throws
/// InputError as read_dem (terrain/raster/read_dem.hpp) does.
Dem elevation_of(const Scene& scene);

}  // namespace diurna
