#include "thermal/surface/frost.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double freezing_span = 2.0;  // [K] over which vapour's heat turns to that of ice

/// Saturation pressure over ice below the triple point, where the two meet, over water above;
/// and its slope.
double saturation_over(double temperature, double& slope) {
    if (temperature >= triple_point) return saturation_over_water(temperature, slope);
    const double t = std::max(temperature, coldest_vapour), inverse = 1.0 / (t - over_ice.b);
    const double pressure =
        triple_point_pressure * std::exp(saturation_exponent(over_ice, t, inverse));
    slope = saturation_slope(over_ice, pressure, inverse);
    return pressure;
}

/// Share of ice's heat in that of the vapour above it.
double frozen_share(double temperature) {
    return std::clamp((zero_celsius - temperature) / freezing_span, 0.0, 1.0);
}

}  // namespace

LatentHeat latent_heat_or_frost(const AirFilm& air, const Film& film, double wetness,
                                double resistance, double temperature) {
    double slope;
    const double excess = saturation_over(temperature, slope) - air.vapour_pressure;
    const bool drying = excess > 0.0;
    const VapourPath path = vapour_path(air, film, drying ? resistance : 0.0);
    const double wet = drying ? wetness : 1.0;
    const double frozen = frozen_share(temperature);
    const double of_ice = latent_heat_of_sublimation(air.air_temperature) /
                          latent_heat_of_vaporisation(air.air_temperature);
    const double heat = air.latent * (1.0 + frozen * (of_ice - 1.0));
    const bool blends = frozen > 0.0 && frozen < 1.0;
    const double heat_slope = blends ? -air.latent * (of_ice - 1.0) / freezing_span : 0.0;
    return {-wet * heat * path.conductance * excess,
            -wet * (heat * (path.conductance * slope + path.steeper * excess) +
                    heat_slope * path.conductance * excess)};
}

double latent_heat_of_sublimation(double temperature) {
    const double t = std::clamp(temperature - zero_celsius, -100.0, 0.0);
    return 2.8341e6 - 290.0 * t - 4.0 * t * t;
}

double heat_of_vapour(double air_temperature, double surface_temperature) {
    const double frozen = frozen_share(surface_temperature);
    return std::lerp(latent_heat_of_vaporisation(air_temperature),
                     latent_heat_of_sublimation(air_temperature), frozen);
}

}  // namespace diurna
