#pragma once

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Triangulates the elevation along the polygons' borders, gives every facet its material and
/// puts up the buildings and objects. The materials of open meshes' two sides are added to the
/// scene's (sheets.hpp). Throws InputError if the elevation cannot be used or something lies
/// outside it.
World build_world(Scene& scene, const Dem& dem);

}  // namespace diurna
