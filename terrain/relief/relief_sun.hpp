#pragma once

#include <Eigen/Core>
#include <span>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// The share of the sun's disc seen from each post, (row, column); direction is a unit vector
/// towards its centre. Zero if the whole disc is below the horizontal. Voids are never in shadow.
void sun_fraction(const HeightField& field, const Eigen::Vector3d& direction,
                  std::span<float> fraction, double lift = 0.0);

}  // namespace diurna
