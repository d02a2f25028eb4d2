#pragma once

#include <Eigen/Core>
#include <span>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// Tangent of the horizon's elevation at each post (row, column) towards an azimuth (clockwise from
/// north): the highest of the relief, at least 0. The eye is `lift` [m] above the post.
void horizon(const HeightField& field, double azimuth_deg, std::span<float> tangent,
             double lift = 0.0);

/// Tangent of the horizon's elevation towards the sun, exact where it is within `margin` [rad] of
/// the sun's centre, else the nearest end of that interval: all that a shadow needs, and faster.
void horizon_near(const HeightField& field, const Eigen::Vector3d& direction, double margin,
                  std::span<float> tangent, double lift = 0.0);

}  // namespace diurna
