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

/// The ground's borders at one building, vertex by vertex [m]: round it counterclockwise, in its
/// courtyards clockwise.
using PlanBorders = std::vector<std::vector<Eigen::Vector3d>>;

/// Ground of the raster, one object per polygon; the shapes of files lie under the polygons and
/// count as ground. Under `buildings` there is none: nobody sees it, and it would meet the walls
/// from behind. Round them it is finer.
///
/// Returns for each building the ground's borders at it; empty where they are not simple lines, as
/// where plans overlap.
std::vector<PlanBorders> append_ground(World& world, const Scene& scene, const Dem& dem,
                                       std::span<const WalledPlan> buildings);

/// The raster's heights along a plan's ring, as far apart as the ground's vertices there,
/// `foot_edge` [m]; empty where it lies outside or over a void.
std::vector<Eigen::Vector3d> raster_border(const Ring& ring, double foot_edge, const Dem& dem,
                                           const Site& site);

}  // namespace diurna
