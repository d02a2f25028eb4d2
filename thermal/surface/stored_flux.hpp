#pragma once

#include <algorithm>

#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

// Contribution of water and frost on a surface to its balance, for both scalar code and loops over
// lanes: no call, no branch.

inline constexpr double freezing_span = 2.0;  // [K] over which vapour's heat turns to that of ice

/// Share of sublimation in the heat of the vapour above it.
[[gnu::always_inline]] inline double frozen_share(double temperature) {
    return std::min(1.0, std::max(0.0, (zero_celsius - temperature) / freezing_span));
}

/// Saturation pressure [Pa] over ice below the triple point, where both are equal, over water above
/// it; and its slope. Linear above 450 K.
[[gnu::always_inline]] inline double saturation_over_frost(double temperature, double& slope) {
    const bool ice = temperature < triple_point;
    const double a = ice ? over_ice.a : over_water.a, b = ice ? over_ice.b : over_water.b;
    const double t = std::min(std::max(temperature, coldest_vapour), hottest_vapour);
    const double inverse = 1.0 / (t - b);
    const double pressure = triple_point_pressure * fast_exp(a * (t - triple_point) * inverse);
    slope = pressure * a * (triple_point - b) * inverse * inverse;
    return pressure + slope * std::max(0.0, temperature - hottest_vapour);
}

/// Vapour above a surface at a temperature: pressure above the air's [Pa] and its slope, and the
/// heat it carries [J m⁻³ Pa⁻¹] with its slope.
struct FrostVapour {
    double excess, slope, heat, heat_slope;
};
/// vapour  AirFilm::latent, or 0 without exchange of vapour
/// of_ice  heat of sublimation over that of vaporisation
[[gnu::always_inline]] inline FrostVapour frost_vapour(const AirFilm& air, double vapour,
                                                       double of_ice, double temperature) {
    FrostVapour v;
    v.excess = saturation_over_frost(temperature, v.slope) - air.vapour_pressure;
    const double frozen = frozen_share(temperature);
    const bool blends = frozen > 0.0 && frozen < 1.0;
    v.heat = vapour * (1.0 + frozen * (of_ice - 1.0));
    v.heat_slope = blends ? -vapour * (of_ice - 1.0) / freezing_span : 0.0;
    return v;
}
/// Latent heat towards the surface [W m⁻²] and d/dT: evaporation from the wet share with a
/// resistance in series with the air's, dew and hoar with the air's only.
[[gnu::always_inline]] inline SurfaceFlux latent_of(const AirFilm& air, const Film& film,
                                                    const FrostVapour& v, double wetness,
                                                    double resistance) {
    const bool drying = v.excess > 0.0;
    const VapourPath path = vapour_path(air, film, drying ? resistance : 0.0);
    const double wet = drying ? wetness : 1.0;
    return {-wet * v.heat * path.conductance * v.excess,
            -wet * (v.heat * (path.conductance * v.slope + path.steeper * v.excess) +
                    v.heat_slope * path.conductance * v.excess)};
}
/// For a surface whose wet share evaporates freely, and the rest as the material does.
[[gnu::always_inline]] inline SurfaceFlux stored_latent(const AirFilm& air, const Film& film,
                                                        double vapour, double of_ice, double share,
                                                        double temperature) {
    const FrostVapour v = frost_vapour(air, vapour, of_ice, temperature);
    const SurfaceFlux free = latent_of(air, film, v, 1.0, 0.0);
    const SurfaceFlux held = latent_of(air, film, v, air.wetness, air.resistance);
    return {share * free.flux + (1.0 - share) * held.flux,
            share * free.slope + (1.0 - share) * held.slope};
}

/// Heat used by melting frost (negative) or released by freezing water on a surface, limited to the
/// amount that melts or freezes all of it within the step [W m⁻²]; and d/dT.
///
/// film  between the surface and the frost or water [W m⁻² K⁻¹]
[[gnu::always_inline]] inline SurfaceFlux melting_flux(double film, double frost_heat,
                                                       double water_heat, double temperature) {
    const double free = film * (temperature - zero_celsius);
    const double taken = std::min(std::max(free, -water_heat), frost_heat);
    const bool turning = free > -water_heat && free < frost_heat;
    return {-taken, turning ? -film : 0.0};
}

}  // namespace diurna
