#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Triangulates the elevation along the polygons' borders, assigns materials to all facets and
/// adds the buildings and objects. The materials of open meshes' two sides are added to the
/// scene's (sheets.hpp). Throws InputError if the elevation cannot be used or something is outside
/// it.
World build_world(Scene& scene, const Dem& dem);

}  // namespace diurna
