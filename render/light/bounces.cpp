#include "render/light/bounces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Of light of sun and sky that a white surface would send back, from above [W m⁻² sr⁻¹].
double sunlit(const BandLight& band) {
    const IncidentLight& highest = band.incident[2];
    return (band_sum_nodes(band.band, highest.sun) +
            (band.scattered ? band_sum_nodes(band.band, highest.aureole) : 0.0)) /
               std::numbers::pi +
           (band.scattered ? band_sum_nodes(band.band, highest.sky) : 0.0);
}

/// Difference of what two surroundings can send, sky among them, from above [W m⁻² sr⁻¹].
double greatest_contrast(const BandLight& band, const TemperatureExtent& extent) {
    double least = band_radiance(band.band, double{extent.coldest});
    double most = band_radiance(band.band, double{extent.hottest});
    for (const IncidentLight& light : band.incident) {
        const double sky = band_sum_nodes(band.band, light.sky);
        least = std::min(least, sky);
        most = std::max(most, sky);
    }
    return most - least + band_sum_nodes(band.band, band.incident[2].sun) / std::numbers::pi;
}

}  // namespace

BounceOptions bounce_options(const BandLight& band, const TemperatureExtent& extent,
                             const ReflectionBounds& bounds, int bounces, double tolerance) {
    constexpr double sunlight_share = 1e-5;
    const double slope = band_radiance_derivative(band.band, double{extent.coldest});
    const double least = std::max({tolerance * slope, sunlight_share * sunlit(band), 1e-300});
    const double contrast = std::max(greatest_contrast(band, extent), 1e-300);
    return {.bounces = bounces,
            .first = static_cast<float>(std::clamp(least / contrast, 1e-30, 1.0)),
            .least = static_cast<float>(
                std::clamp(least * (1.0 - double{bounds.strongest}), 1e-30, 1e30))};
}

double left_over(const BandLight& band, const TemperatureExtent& extent,
                 const ReflectionBounds& bounds, const BounceOptions& options) {
    const double strongest = double{bounds.strongest};
    const double beyond = options.bounces >= all_bounces
                              ? 0.0
                              : std::min(1.0, std::pow(strongest, options.bounces + 1));
    const double share = beyond + double{options.first} + double{least_reach};
    return greatest_contrast(band, extent) * share + double{options.least} / (1.0 - strongest);
}

}  // namespace diurna
