#pragma once

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/air/saturation.hpp"
#include "materials/matter/material.hpp"
#include "thermal/surface/film.hpp"
#include "thermal/surface/plate_film.hpp"

namespace diurna {

/// The bulk Richardson number above which stability damps no further: over ground that is not
/// smooth and level for kilometres, air in calm nights still moves by drainage and waves that the
/// mean wind does not include. Martin and Lejeune (1998, Ann. Glaciol. 26, 179) limit it in this
/// way over alpine snow, as SURFEX does since; 0.1 is chosen from data on snow (Weissfluhjoch,
/// November and December) and stubble (Bondville, January to March).
inline constexpr double stable_limit = 0.1;

/// Bulk transfer of heat between ground and air after Monin and Obukhov, in Louis's closed form
/// (1979): the neutral coefficient times a function of the bulk Richardson number only,
///
///     h = ρ cp k² U / (L_m L_h) · F(x),      x = −Ri = g z_u (T_s − T_a) / (T_a U²)
///     F = 1 + a x / (1 + c √x)               ground warmer than the air
///     F = 1 / (1 + s y √(1 + 30 y)), y = −x  ground colder, y at most stable_limit
///
/// with L_m = ln(z_u / z0), L_h = ln(z_t / z0h). a, c and s depend on the heights and roughness
/// lengths: s is the exact slope at neutrality, a and c are fitted once to Businger and Dyer's
/// functions over −10 < z/L < −0.001, to 2-6 % of their iterated solution
/// (tests/thermal/turbulence_test).
struct LouisForm {
    double log_momentum, log_heat;  // L_m, L_h
    double wind_height;             // [m]
    double a, c, s;
    double worst_fit;  // largest relative error of F over the fitted range
};

/// wind_height, air_height  [m] above the displaced ground; at least twice the roughness length
///
/// roughness lengths        [m] momentum and heat, positive
LouisForm louis_form(double roughness_length, double heat_roughness_length, double wind_height,
                     double air_height);

/// Exchange of heat and vapour between one kind of surface and the air at one instant: inputs of
/// the balance kernel, the same for all facets of a material.
struct AirFilm {
    double air_temperature;  // [K]
    double neutral;          // [W m⁻² K⁻¹] film at neutrality, or the constant
    double instability;      // [K⁻¹] x per kelvin of surface excess; 0 for plates and constants
    double a, c, s;          // of LouisForm; 0 for plates and constants
    double least;            // [W m⁻² K⁻¹] added to ground's film
    double heat_capacity;    // [J m⁻³ K⁻¹] ρ cp of the air
    double vapour_pressure;  // [Pa] of the air
    double latent;           // [J m⁻³ Pa⁻¹] ρ L_v 0.622 / p
    double resistance;       // [s m⁻¹] of the surface to evaporation
    double wetness;          // 0: neither evaporation nor dew
    FilmKind kind;           // ground_film, wall_film or body_film
    PlateAir plate;          // of walls and bodies
};

/// wind below 0.3 m s⁻¹ is set to 0.3: drift in calm air
inline constexpr double least_wind = 0.3;

/// For a surface in flight the wind is its speed, and the air has the recovery temperature.
AirFilm air_film(const ThermalSurface& surface, const LouisForm& louis, const AirState& air,
                 double wind_speed);

/// Ground ((T3) of docs/theory.md) or constant film, F = n / d, dF/dx = g / d². One root and one
/// division for both: the compiler would make two of a selection, so the cases are blended.
[[gnu::always_inline]] inline Film ground_film(const AirFilm& air, double temperature) {
    const double excess = air.instability * (temperature - air.air_temperature);
    const double x = std::max(excess, -stable_limit);
    // Warm, r = √x:           d = 1 + c r,       n = d + a x,  g = a (1 + c r / 2).
    // Cold, r = √(1 + 30 y):  d = r (1 + s y r), n = r,        g = s (1 + 45 y) r.
    const double warm = static_cast<double>(x > 0.0), cold = 1.0 - warm;
    const double r = std::sqrt(cold + x * (31.0 * warm - 30.0));
    const double d = (warm + cold * r) * (1.0 + r * (warm * air.c - cold * air.s * x));
    const double n = warm * (d + air.a * x) + cold * r;
    const double g = warm * air.a * (1.0 + 0.5 * air.c * r) + cold * air.s * (1.0 - 45.0 * x) * r;
    const double inverse = 1.0 / d;
    const double follows = static_cast<double>(excess >= -stable_limit);
    const double steepness = follows * air.neutral * g * inverse * inverse;
    return {air.neutral * n * inverse + air.least, steepness * x, steepness * air.instability};
}

/// Conductance for vapour, the air's film and a resistance [s m⁻¹] in series, over ρ cp [m s⁻¹],
/// and its d/dT_s.
struct VapourPath {
    double conductance, steeper;
};
[[gnu::always_inline]] inline VapourPath vapour_path(const AirFilm& air, const Film& film,
                                                     double resistance) {
    const double in_series = 1.0 / (air.heat_capacity + resistance * film.h);
    return {film.h * in_series, air.heat_capacity * in_series * in_series * film.slope};
}

/// Latent heat towards the surface [W m⁻²] and d/dT_s: evaporation from the wet share with the
/// surface's resistance in series with the air's, dew with the air's only.
/// (T11) of docs/theory.md
/// excess  [Pa] of saturation at the surface over the air's vapour; its slope [Pa K⁻¹]
struct LatentHeat {
    double flux, slope;
};
[[gnu::always_inline]] inline LatentHeat latent_heat(const AirFilm& air, const Film& film,
                                                     double excess, double pressure_slope) {
    const bool drying = excess > 0.0;
    const VapourPath path = vapour_path(air, film, drying ? air.resistance : 0.0);
    const double share = air.latent * (drying ? air.wetness : 1.0);
    return {-share * path.conductance * excess,
            -share * (path.conductance * pressure_slope + path.steeper * excess)};
}
[[gnu::always_inline]] inline LatentHeat latent_heat(const AirFilm& air, const Film& film,
                                                     double temperature) {
    double slope;
    const double excess = saturation_over_water(temperature, slope) - air.vapour_pressure;
    return latent_heat(air, film, excess, slope);
}

/// Air interpolated (or extrapolated) between two instants. Value by value: loops that copy a whole
/// AirFilm are not vectorised.
[[gnu::always_inline]] inline AirFilm air_between(const AirFilm& before, const AirFilm& after,
                                                  double share) {
    const double back = 1.0 - share;
    const auto between = [back](double from, double to) __attribute__((always_inline)) {
        return to + back * (from - to);
    };
    const PlateAir &from = before.plate, &to = after.plate;
    return {.air_temperature = between(before.air_temperature, after.air_temperature),
            .neutral = between(before.neutral, after.neutral),
            .instability = between(before.instability, after.instability),
            .a = after.a,
            .c = after.c,
            .s = after.s,
            .least = after.least,
            .heat_capacity = between(before.heat_capacity, after.heat_capacity),
            .vapour_pressure = between(before.vapour_pressure, after.vapour_pressure),
            .latent = between(before.latent, after.latent),
            .resistance = after.resistance,
            .wetness = after.wetness,
            .kind = after.kind,
            .plate = {.conduct = between(from.conduct, to.conduct),
                      .sixth = between(from.sixth, to.sixth),
                      .quarter = between(from.quarter, to.quarter),
                      .third = between(from.third, to.third),
                      .laminar = between(from.laminar, to.laminar),
                      .turbulent = between(from.turbulent, to.turbulent),
                      .edge = between(from.edge, to.edge),
                      .warming = to.warming,
                      .roughness = to.roughness,
                      .quadratic = to.quadratic}};
}

}  // namespace diurna
