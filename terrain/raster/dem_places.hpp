#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Geodetic positions of fractional posts (column, row) with their heights, by PROJ through the
/// raster's CRS.
std::vector<Geodetic> geodetic_places(const Dem& dem, std::span<const Eigen::Vector2d> place,
                                      std::span<const float> height);

/// Places in the raster as east, north, up [m] in the frame of the site, curvature included.
std::vector<Eigen::Vector3d> local_vertices(const Dem& dem, const Site& site,
                                            std::span<const Eigen::Vector2d> place,
                                            std::span<const float> height);

/// Fractional (column, row) of geodetic positions (heights are not used), or of points of the
/// ground given by east and north [m] in the frame of the site. Positions outside the raster give
/// values outside [0, columns − 1] × [0, rows − 1].
std::vector<Eigen::Vector2d> raster_places(const Dem& dem, std::span<const Geodetic> places);
std::vector<Eigen::Vector2d> raster_places(const Dem& dem, const Site& site,
                                           std::span<const Eigen::Vector2d> east_north);

/// Distance [m] between neighbouring columns and between neighbouring rows, mid-raster.
Eigen::Vector2d post_spacing(const Dem& dem);

/// The place in the middle of the raster, at the height of the nearest valid post.
Geodetic dem_centre(const Dem& dem);
/// Height [m] as by height_at of dem.hpp.
double height_at(const Dem& dem, double latitude_deg, double longitude_deg);

}  // namespace diurna
