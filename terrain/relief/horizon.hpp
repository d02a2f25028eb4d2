#pragma once

#include <Eigen/Core>
#include <span>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// Tangent of the horizon's elevation at each post (row, column) towards an azimuth (clockwise from
/// north): the highest of the relief, at least 0. The observer is `lift` [m] above the post.
void horizon(const HeightField& field, double azimuth_deg, std::span<float> tangent,
             double lift = 0.0);

/// Tangent of the horizon's elevation towards the sun: exact within `margin` [rad] of the sun's
/// centre, clamped to that interval otherwise; sufficient for shadows, and faster.
void horizon_near(const HeightField& field, const Eigen::Vector3d& direction, double margin,
                  std::span<float> tangent, double lift = 0.0);

}  // namespace diurna
