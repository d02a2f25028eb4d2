#pragma once

#include "render/light/band_light.hpp"
#include "render/light/lit_facets.hpp"

namespace diurna {

/// Limits of the interreflections computed in a band.
struct BounceOptions {
    int bounces = all_bounces;  // 1: reflections between surroundings count as black
    float first = 1e-6f;        // share of its radiosity below which a facet's surroundings
                                // count as black
    float least = 1e-6f;        // [W m⁻² sr⁻¹] contribution of a bounce that is deferred
};
/// The omitted part is below the tolerance, or 1e-5 of the sun and sky light reflected by a white
/// surface, whichever is more.
///
/// - tolerance: [K] at the scene's cold end
BounceOptions bounce_options(const BandLight& band, const TemperatureExtent& extent,
                             const ReflectionBounds& bounds, int bounces, double tolerance);

/// Upper bound on the omitted radiance [W m⁻² sr⁻¹] of a visible facet.
double left_over(const BandLight& band, const TemperatureExtent& extent,
                 const ReflectionBounds& bounds, const BounceOptions& options);

}  // namespace diurna
