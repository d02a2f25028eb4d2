#pragma once

#include "scenes/input/scene.hpp"
#include "scenes/world/sheets.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Puts the copies of objects into a world in which all else stands.
///
/// Those whose surroundings are alike (surroundings.hpp), by no more than the object's
/// `alike_within` from a copy before them, have the facets, the materials and so the temperatures
/// of that one and are placements in World::copies; every other copy is an object with facets of
/// its own, as any. A note reports how many are which and the largest estimate of what that is
/// worth. The work is that of a few thousand rays for each copy, and a comparison with each that
/// has facets of its own and heads nearly as it does.
///
/// Throws InputError where a texture lies on a material of theirs.
void append_copies(World& world, Scene& scene, const Dem& dem, Sheets& sheets);

}  // namespace diurna
