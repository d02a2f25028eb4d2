#pragma once

#include "scenes/job/input/scene.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The elevation of a scene: the one already read for its places, or read here (read_elevation).
/// Throws InputError as that does.
Dem elevation_of(const Scene& scene);

}  // namespace diurna
