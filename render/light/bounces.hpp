#pragma once

#include "render/light/band_light.hpp"
#include "render/light/lit_facets.hpp"

namespace diurna {

/// How much of the light that surfaces reflect of each other is followed in a band.
struct BounceOptions {
    int bounces = 2;           // 1: what surroundings reflect of each other counts as black
    float tolerance = 3e-4f;   // [K] a second bounce is left out where it changes less
    float most_change = 1e3f;  // [K] no facet around differs by more, sunlight included
};
/// With the worth of sunlight and of the scene's spread in kelvins at its cold end.
///
/// - tolerance: [K]
BounceOptions bounce_options(const BandLight& band, const TemperatureExtent& extent, int bounces,
                             double tolerance);

/// Bound on the radiance [W m⁻² sr⁻¹] that goes on after the bounces followed, surroundings left
/// out for being below tolerance included.
double left_over(const BandLight& band, const TemperatureExtent& extent,
                 const ReflectionBounds& bounds, const BounceOptions& options);

}  // namespace diurna
