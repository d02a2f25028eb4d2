#pragma once

#include "render/light/band_light.hpp"
#include "render/light/lit_facets.hpp"

namespace diurna {

/// How much of the light that surfaces reflect of each other is followed in a band.
struct BounceOptions {
    int bounces = all_bounces;  // 1: what surroundings reflect of each other counts as black
    float first = 1e-6f;  // share of what it sends below which a facet's surroundings count as
                          // black
    float least = 1e-6f;  // [W m⁻² sr⁻¹] what a bounce adds to a facet's radiance waits below
};
/// What is skipped is below the tolerance, or 1e-5 of the light of sun and sky that a white
/// surface would send back, whichever is more.
///
/// - tolerance: [K] at the scene's cold end
BounceOptions bounce_options(const BandLight& band, const TemperatureExtent& extent,
                             const ReflectionBounds& bounds, int bounces, double tolerance);

/// Bound on the radiance [W m⁻² sr⁻¹] of a facet seen that is skipped.
double left_over(const BandLight& band, const TemperatureExtent& extent,
                 const ReflectionBounds& bounds, const BounceOptions& options);

}  // namespace diurna
