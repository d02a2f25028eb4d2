#pragma once

#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// The line of sight from an eye to a target through the air.
///
/// - target_height: [m] above the sea
/// - elevation_deg: of the eye above the target's level
/// - range: [m]
SightLine line_to_target(double target_height, double elevation_deg, double range);

/// The air's transmittance in a band along a line through a target, over range: the mean weighted
/// by Planck's slope at 300 K.
class AirOnLine {
 public:
    /// - target_height: [m] above the sea
    /// - elevation_deg: of the eye above the target's level
    /// - farthest: [m]
    AirOnLine(const Atmosphere& air, const Band& band, double target_height, double elevation_deg,
              double farthest);
    /// Its logarithm is linear in the cube root of range between 96 knots.
    double operator()(double range) const;

 private:
    static constexpr int knots = 96;
    double root_step_ = 1.0;
    std::vector<double> logs_;
};

}  // namespace diurna
