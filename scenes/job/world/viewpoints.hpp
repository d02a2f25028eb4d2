#pragma once

#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// How much coarser than the scene's tolerance the ground may be at each post
/// (level_of_detail.hpp): a pixel of each observer, from up to 32 places of a moving one; a
/// hundredth of the distance from each building, object and polygon. Empty: no coarser.
std::vector<float> slack_of(const Scene& scene, const Dem& dem, const World& world);

}  // namespace diurna
