#include "render/light/bounces.hpp"

#include <algorithm>
#include <numbers>

#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Difference of what two surroundings can send, from above [W m⁻² sr⁻¹].
double greatest_contrast(const BandLight& band, const TemperatureExtent& extent) {
    const IncidentLight& highest = band.incident[2];
    const double warmth = band_radiance(band.band, double{extent.hottest}) -
                          band_radiance(band.band, double{extent.coldest});
    return warmth + band_sum_nodes(band.band, highest.sun) / std::numbers::pi +
           (band.scattered ? band_sum_nodes(band.band, highest.sky) : 0.0);
}

}  // namespace

BounceOptions bounce_options(const BandLight& band, const TemperatureExtent& extent, int bounces,
                             double tolerance) {
    const double slope = band_radiance_derivative(band.band, double{extent.coldest});
    const double contrast = greatest_contrast(band, extent);
    return {.bounces = bounces,
            .tolerance = static_cast<float>(tolerance),
            .most_change =
                static_cast<float>(std::clamp(contrast / std::max(slope, 1e-300), 1e-3, 1e30))};
}

double left_over(const BandLight& band, const TemperatureExtent& extent,
                 const ReflectionBounds& bounds, const BounceOptions& options) {
    const double contrast = greatest_contrast(band, extent);
    const float most_twice =
        bounds.twice.empty() ? 0.0f : *std::max_element(bounds.twice.begin(), bounds.twice.end());
    if (options.bounces < 2) return contrast * double{most_twice};
    const double skipped = double{options.tolerance} / double{options.most_change};
    return contrast * (double{bounds.thrice} + std::min(skipped, double{most_twice}));
}

}  // namespace diurna
