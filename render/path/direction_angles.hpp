#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

// Angles [deg] of unit vectors in east, north, up.

inline double angle_between_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return degrees(std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
}

inline double zenith_deg_of(const Eigen::Vector3d& direction) {
    return degrees(std::acos(std::clamp(direction.z(), -1.0, 1.0)));
}

/// Clockwise from north.
inline double azimuth_of(const Eigen::Vector3d& direction) {
    return std::atan2(direction.x(), direction.y());
}

/// Azimuth relative to the sun's, −360 to 360.
inline double azimuth_from_sun_deg(const Eigen::Vector3d& direction,
                                   const Eigen::Vector3d& to_sun) {
    return degrees(azimuth_of(direction) - azimuth_of(to_sun));
}

}  // namespace diurna
