#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <tuple>

#include "materials/base/random.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/lifted_facet.hpp"

namespace diurna {

/// Point k of a sequence that fills the unit square evenly (Roberts' R2), from a random
/// start.
inline Eigen::Vector2d evenly(int k, const Eigen::Vector2d& start) {
    const double x = start.x() + even_step_x * k, y = start.y() + even_step_y * k;
    return {x - std::floor(x), y - std::floor(y)};
}

/// Directions over the sun's disc.
class SunDisc {
 public:
    /// - direction: unit, towards its centre
    explicit SunDisc(const Eigen::Vector3d& direction) : direction_(direction) {
        std::tie(east_, north_) = tangents(direction);
    }

    /// Maps u, v of the unit square to directions uniform over the disc, continuously (Shirley &
    /// Chiu 1997).
    Eigen::Vector3d towards(double u, double v) const {
        const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
        if (a == 0.0 && b == 0.0) return direction_;
        constexpr double quarter = std::numbers::pi / 4.0;
        const bool flat = std::abs(a) > std::abs(b);
        const double radius = radius_ * (flat ? a : b);
        // The angle from the nearer axis is at most 45°, where the series are good to 1e-15.
        const double t = quarter * (flat ? b / a : a / b), s = t * t;
        double sine = 1.0, cosine = 1.0;
        for (const double k : {14.0, 12.0, 10.0, 8.0, 6.0, 4.0, 2.0}) {
            sine = 1.0 - s * (1.0 / (k * (k + 1.0))) * sine;
            cosine = 1.0 - s * (1.0 / (k * (k - 1.0))) * cosine;
        }
        sine *= t;
        return (direction_ +
                radius * ((flat ? cosine : sine) * east_ + (flat ? sine : cosine) * north_))
            .normalized();
    }

 private:
    Eigen::Vector3d direction_, east_, north_;
    double radius_ = std::tan(sun_angular_radius);
};

}  // namespace diurna
