#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"

/// The ground of a scene: elevation as triangles, each of its material.
namespace diurna {

/// The point of the ground below or above (east, north) in the site's frame, from the raster.
/// Throws InputError(where, ...) outside the raster or over a void.
Eigen::Vector3d ground_point(const Dem& dem, const Site& site, const Eigen::Vector2d& place,
                             const std::string& where);

/// Ground of the raster, one object per polygon; the shapes of files lie under the polygons and
/// count as ground. Under `buildings` (rings, east and north) there is none: nobody sees it, and it
/// would meet the walls from behind.
void append_ground(World& world, const Scene& scene, const Dem& dem,
                   const std::vector<std::vector<Eigen::Vector2d>>& buildings);

/// Marks the ground facets whose elevation was filled in.
void mark_filled(World& world, const Dem& dem);

}  // namespace diurna
