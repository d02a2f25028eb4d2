#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/ground_cuts.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// The ground of a scene: elevation as triangles, each of its material.
namespace diurna {

/// Ground of the raster, one object per polygon; the shapes of files lie under the polygons and
/// count as ground. Under `buildings` there is none: nobody sees it, and it would meet the walls
/// from behind. Round them it is finer.
///
/// Returns for each building the ground's border at it, vertex by vertex, counterclockwise [m];
/// empty where that is not one simple line, as where plans overlap.
std::vector<std::vector<Eigen::Vector3d>> append_ground(World& world, const Scene& scene,
                                                        const Dem& dem,
                                                        std::span<const WalledPlan> buildings);

/// The raster's heights round a plan, as far apart as the ground's vertices there; empty where it
/// lies outside or over a void.
std::vector<Eigen::Vector3d> raster_border(const WalledPlan& plan, const Dem& dem,
                                           const Site& site);

}  // namespace diurna
