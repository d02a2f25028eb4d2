#pragma once

#include <limits>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna {

/// The clear sky whose formulas light is divided by: with no more aerosol than 23 km of visibility
/// have, so that fog leaves something to divide by.
ClearSky reference_sky(ClearSky clear);

/// A scene's light at a height over broadband formulas of a clear sky there, reference_sky().
struct LightRatio {
    double direct = 0.0, diffuse = 0.0;  // over clear_sunlight()
    double longwave = 1.0;               // over clear_longwave()
};

/// The light of a scene's air by height, where the formulas that carry a station's light to other
/// heights do not hold: above the cloud's top (all light), and in haze thicker than usual
/// (sunlight). Linear in height and in time between its values, constant beyond them.
///
/// Ratios are smooth where light is not: the sun's course is the formula's.
struct LightByHeight {
    double cloud_top = std::numeric_limits<double>::infinity();  // [m] above the sea
    bool by_haze = false;                                        // below the cloud too
    std::vector<Instant> instant;                                // ascending; not empty
    std::vector<double> height;     // [m] above the sea, ascending; not empty
    std::vector<LightRatio> ratio;  // (instant, height)

    /// Whether it has the light there; else the formulas have.
    bool has_sunlight(double at) const { return by_haze || at >= cloud_top; }
    bool has_longwave(double at) const { return at >= cloud_top; }
    LightRatio at(Instant when, double at_height) const;
    /// Heights on both sides of each discontinuity of the light.
    std::vector<double> edges() const;
};

}  // namespace diurna
