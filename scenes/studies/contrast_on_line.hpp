#pragma once

#include <functional>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/sunlit_air.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Apparent temperatures of a target and its background in a picture, in a band [K].
struct SeenContrast {
    double range = 0.0;  // [m] from the target
    double target = 0.0, background = 0.0;
    double spread = 0.0;  // standard deviation over the target
};

/// The line from a target to an eye, and the sun over it.
struct LineOfContrast {
    double target_height = 0.0;         // [m] above the sea
    double elevation_deg = 0.0;         // of the eye above the target's level
    SunLight sun{};                     // at night its zenith angle is 90 degrees or more
    double azimuth_from_sun_deg = 0.0;  // of the direction from the eye to the target
};

/// The contrast of a picture converted to other ranges on the same line of sight, with
/// transmission at every wavelength of the band: target and background are black bodies
/// with the picture's radiance behind the air at the picture's range; the air at
/// another range transmits their light and adds its own and scattered sunlight; the
/// result is the difference of apparent temperatures there. Aspect and background are
/// unchanged.
///
/// Exactly the picture's contrast at its own range (tests/scenes/contrast_test.cpp).
class ContrastOnLine {
 public:
    ContrastOnLine(const Atmosphere& air, const Band& band, const LineOfContrast& line,
                   const SeenContrast& seen);
    /// [K] root sum square of difference and spread at a range [m].
    double operator()(double range) const;

 private:
    PathSpectrum path(double range) const;
    /// Apparent temperature [K] of a black body behind a path.
    double seen_through(const PathSpectrum& path, double kelvin) const;
    /// The temperature of the black body with such an apparent temperature behind it.
    double body_behind(const PathSpectrum& path, double apparent) const;

    const Atmosphere& air_;
    Band band_;
    LineOfContrast line_;
    std::function<std::vector<double>(const SightLine&, double)> scattered_;
    double target_ = 0.0, background_ = 0.0;  // [K] the bodies
    double spread_ = 0.0;                     // [K] of the target's
    double scale_ = 1.0;                      // factor to the picture's own
};

/// The same at many ranges up to the farthest: its logarithm is linear in the cube root of range
/// between 96 knots.
class ContrastOverRange {
 public:
    ContrastOverRange(const ContrastOnLine& line, const SeenContrast& seen, double farthest);
    double operator()(double range) const;

 private:
    double logarithm(double range) const;

    static constexpr int knots = 96;
    double root_step_ = 1.0, offset_ = 0.0;
    std::vector<double> logs_;
};

}  // namespace diurna
