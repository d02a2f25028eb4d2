#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The point of the ground below or above (east, north) in the site's frame, from the raster.
/// Throws InputError(where, ..., hint) outside the raster or over a void.
Eigen::Vector3d ground_point(const Dem& dem, const Site& site, const Eigen::Vector2d& place,
                             const std::string& where, const std::string& hint = "");

/// The same; nothing if there is no ground.
std::optional<Eigen::Vector3d> ground_if_any(const Dem& dem, const Site& site,
                                             const Eigen::Vector2d& place);

}  // namespace diurna
