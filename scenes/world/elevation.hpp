#pragma once

#include "scenes/input/scene.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The elevation that a scene stands on: what its places have read already, or read anew
/// (read_elevation). Throws InputError as that does.
Dem elevation_of(const Scene& scene);

}  // namespace diurna
