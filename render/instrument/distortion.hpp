#pragma once

#include <Eigen/Core>

#include "render/instrument/instrument.hpp"

namespace diurna {

/// Brown's law (1971), as in OpenCV: position in the distorted picture of a pinhole's position
/// `place`. Positions are x/f to the right and y/f downward from the axis.
///
///     x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2x²)
///     y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2y²) + 2 p2 x y
Eigen::Vector2d distorted(const Lens& lens, const Eigen::Vector2d& place);

/// The inverse, by Newton's method to 1e-12. Throws InputError where the law folds over and has no
/// inverse.
Eigen::Vector2d undistorted(const Lens& lens, const Eigen::Vector2d& place);

bool distorts(const Lens& lens);

}  // namespace diurna
