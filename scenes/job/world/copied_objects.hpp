#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/sheets.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Adds the copies of objects to a world with everything else.
///
/// A copy whose surroundings are similar (surroundings.hpp) to those of an earlier copy, within
/// the object's `alike_within`, uses the facets, the materials and so the temperatures of that
/// one and is a placement in World::copies; every other copy is a separate object with its own
/// facets. A note reports both numbers and the largest estimated difference. Takes a few thousand
/// rays for each copy, and a comparison with each that has its own facets and nearly the same
/// heading.
///
/// Throws InputError if a texture is on one of their materials.
void append_copies(World& world, Scene& scene, const Dem& dem, Sheets& sheets);

}  // namespace diurna
