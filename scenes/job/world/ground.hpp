#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/ground_cuts.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// The ground of a scene: elevation as triangles, each with its material.
namespace diurna {

/// The ground's borders at one building, vertex by vertex [m]: around it counterclockwise, in its
/// courtyards clockwise.
using PlanBorders = std::vector<std::vector<Eigen::Vector3d>>;

/// Ground of the raster, one object per polygon; shapes from files are below the polygons and count
/// as ground. There is none under `buildings`: it is invisible, and it would see the walls from
/// behind. Around them it is finer.
///
/// Returns for each building the ground's borders at it; empty if they are not simple lines, for
/// example where plans overlap.
std::vector<PlanBorders> append_ground(World& world, const Scene& scene, const Dem& dem,
                                       std::span<const WalledPlan> buildings);

/// The raster's heights along a plan's ring, at the spacing of the ground's vertices there,
/// `foot_edge` [m]; empty if it is outside or over a void.
std::vector<Eigen::Vector3d> raster_border(const Ring& ring, double foot_edge, const Dem& dem,
                                           const Site& site);

}  // namespace diurna
