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
///
/// `Value` is a number (AirFilm), or one for each lane (FilmLanes) of what differs between instants
/// and heights; `Own` likewise of what differs between facets of one kind of film.
template <class Value, class Own>
struct AirFilmOf {
    Value air_temperature;  // [K]
    Value neutral;          // [W m⁻² K⁻¹] film at neutrality, or the constant
    Value instability;      // [K⁻¹] x per kelvin of surface excess; 0 for plates, constants
    double a, c, s;         // of LouisForm; 0 for plates and constants
    Own least;              // [W m⁻² K⁻¹] added to ground's film
    Value heat_capacity;    // [J m⁻³ K⁻¹] ρ cp of the air
    Value vapour_pressure;  // [Pa] of the air
    Value latent;           // [J m⁻³ Pa⁻¹] ρ L_v 0.622 / p
    double resistance;      // [s m⁻¹] of the surface to evaporation
    double wetness;         // 0: neither evaporation nor dew
    FilmKind kind;          // ground_film, wall_film or body_film
    PlateAirOf<Value, Own> plate;  // of walls and bodies
};
using AirFilm = AirFilmOf<double, double>;

/// The fields of films, in the only list of them besides the declarations: calls varies(field of
/// each film...) for what differs between instants and heights, own(...) for the others. Field by
/// field, as loops that copy a whole AirFilm are not vectorised. First those of all films, then
/// those of plates alone.
template <class Varies, class Own, class... Films>
[[gnu::always_inline]] inline void each_air_field(const Varies& varies, const Own& own,
                                                  Films&... of) {
    varies(of.air_temperature...);
    varies(of.neutral...);
    varies(of.instability...);
    varies(of.heat_capacity...);
    varies(of.vapour_pressure...);
    varies(of.latent...);
    own(of.a...);
    own(of.c...);
    own(of.s...);
    own(of.least...);
    own(of.resistance...);
    own(of.wetness...);
    own(of.kind...);
}
template <class Varies, class Own, class... Films>
[[gnu::always_inline]] inline void each_plate_field(const Varies& varies, const Own& own,
                                                    Films&... of) {
    varies(of.plate.conduct...);
    varies(of.plate.sixth...);
    varies(of.plate.quarter...);
    varies(of.plate.third...);
    varies(of.plate.laminar...);
    varies(of.plate.turbulent...);
    varies(of.plate.edge...);
    own(of.plate.warming...);
    own(of.plate.roughness...);
    own(of.plate.quadratic...);
}

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

/// Air interpolated (or extrapolated) between two instants.
[[gnu::always_inline]] inline AirFilm air_between(const AirFilm& before, const AirFilm& after,
                                                  double share) {
    const double back = 1.0 - share;
    const auto between = [back](double& at, double from, double to) __attribute__((always_inline)) {
        at = to + back * (from - to);
    };
    const auto later = [](auto& at, auto, auto to) __attribute__((always_inline)) { at = to; };
    AirFilm air;
    each_air_field(between, later, air, before, after);
    each_plate_field(between, later, air, before, after);
    return air;
}

}  // namespace diurna
