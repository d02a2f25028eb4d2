#pragma once

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/air/saturation.hpp"
#include "materials/base/cube_root.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// The bulk Richardson number beyond which colder ground damps the air no further: over ground that
/// is not smooth and level for kilometres air in calm nights still moves by drainage and waves that
/// no mean wind tells of. Martin and Lejeune (1998, Ann. Glaciol. 26, 179) hold it down over alpine
/// snow so, as SURFEX does since; 0.1 is chosen on snow (Weissfluhjoch, November and December) and
/// stubble (Bondville, January to March).
inline constexpr double stable_limit = 0.1;

/// Bulk transfer of heat between ground and air after Monin and Obukhov, in Louis's closed form
/// (1979): the neutral coefficient times a function of the bulk Richardson number alone,
///
///     h = ρ cp k² U / (L_m L_h) · F(x),      x = −Ri = g z_u (T_s − T_a) / (T_a U²)
///     F = 1 + a x / (1 + c √x)               ground warmer than the air
///     F = 1 / (1 + s y √(1 + 30 y)), y = −x  ground colder, y no more than stable_limit
///
/// with L_m = ln(z_u / z0), L_h = ln(z_t / z0h). a, c and s belong to the heights and roughness
/// lengths: s is the exact slope at neutrality, a and c are fitted once to Businger and Dyer's
/// functions over −10 < z/L < −0.001, to 2-6 % of their iterated solution
/// (tests/thermal/turbulence_test).
struct LouisForm {
    double log_momentum, log_heat;  // L_m, L_h
    double wind_height;             // [m]
    double a, c, s;
    double worst_fit;  // largest relative error of F over the fitted range
};

/// wind_height, air_height  [m] above the displaced ground; raised to twice the roughness length
///                          where they are less
/// roughness lengths        [m] momentum and heat, positive
LouisForm louis_form(double roughness_length, double heat_roughness_length, double wind_height,
                     double air_height);

/// Natural convection of a flat plate, h = C |ΔT|^⅓ (Walton's TARP 1983): the factor
/// C [W m⁻² K⁻⁴ᐟ³] of a plate warmer and one colder than the air. 1.31 both for a wall.
///
/// up_cosine  upward part of the outward normal, −1 to 1
struct NaturalFilm {
    double warm, cold;
};
NaturalFilm natural_film(double up_cosine);

/// Forced part of TARP's film [W m⁻² K⁻¹]: 2.537 W_f R_f √(P U / A), rough plaster (R_f 1.67), a
/// plate of 10 m (P/A 0.4 m⁻¹), mean of windward and leeward (W_f 0.75).
double tarp_forced(double wind_speed);
/// Forced part of DOE-2's MoWiTT film, windward: 3.26 U^0.89.
double mowitt_forced(double wind_speed);

/// How one kind of surface exchanges heat and vapour with the air at one instant: what the balance
/// kernel needs, the same for all facets of a material.
struct AirFilm {
    double air_temperature;  // [K]
    double neutral;          // [W m⁻² K⁻¹] film at neutrality, or the constant or forced film
    double instability;      // [K⁻¹] x per kelvin of surface excess; 0 for plates and constants
    double a, c, s;          // of LouisForm; 0 for plates and constants
    double least;            // [W m⁻² K⁻¹] added to ground's film
    double heat_capacity;    // [J m⁻³ K⁻¹] ρ cp of the air
    double vapour_pressure;  // [Pa] of the air
    double latent;           // [J m⁻³ Pa⁻¹] ρ L_v 0.622 / p
    double resistance;       // [s m⁻¹] of the surface to evaporation
    double wetness;          // 0: neither evaporation nor dew
    bool plate;              // TARP or MoWiTT: plate_film, else ground_film
    bool quadratic;          // MoWiTT
};

/// wind below 0.3 m s⁻¹ counts as 0.3: drift in calm air
inline constexpr double least_wind = 0.3;

/// Air as warm as a surface that moves through it would find it (recovery temperature):
/// T (1 + r (γ − 1)/2 M²) with r = 0.89, turbulent, and γ = 1.4.
double recovery_temperature(double air_temperature, double speed);

AirFilm air_film(const ThermalSurface& surface, const LouisForm& louis, const AirState& air,
                 double wind_speed);

/// A film between surface and air [W m⁻² K⁻¹]; (T_s − T_a) dh/dT_s, which stays finite where the
/// two are equally warm; and dh/dT_s for the latent heat, zero for plates: there a step of Newton's
/// more costs less.
struct Film {
    double h, rise, slope;
};

/// Ground (Louis) or constant film, F = n / d and dF/dx = g / d². One root and one division for
/// both branches: of a choice between them the compiler makes two of each, so they are blended.
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

/// A plate under natural and forced convection: their sum (TARP) or their root sum of squares
/// (MoWiTT).
[[gnu::always_inline]] inline Film plate_film(const AirFilm& air, NaturalFilm natural,
                                              double temperature) {
    const double excess = temperature - air.air_temperature;
    const double n = (excess > 0.0 ? natural.warm : natural.cold) * cube_root(std::abs(excess));
    if (!air.quadratic) return {n + air.neutral, n / 3.0, 0.0};
    const double h = std::sqrt(n * n + air.neutral * air.neutral);
    return {h, h > 0.0 ? n * n / (3.0 * h) : 0.0, 0.0};
}

/// What carries vapour, the air's film and a resistance [s m⁻¹] in series, over ρ cp [m s⁻¹], and
/// d/dT_s of it.
struct VapourPath {
    double conductance, steeper;
};
[[gnu::always_inline]] inline VapourPath vapour_path(const AirFilm& air, const Film& film,
                                                     double resistance) {
    const double in_series = 1.0 / (air.heat_capacity + resistance * film.h);
    return {film.h * in_series, air.heat_capacity * in_series * in_series * film.slope};
}

/// Latent heat towards the surface [W m⁻²] and d/dT_s: evaporation from the wet share against the
/// surface's resistance in series with the air's, dew against the air's alone.
///
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

/// Air on the straight line from one instant to another (and beyond).
[[gnu::always_inline]] inline AirFilm air_between(const AirFilm& before, const AirFilm& after,
                                                  double share) {
    AirFilm air = after;
    const double back = 1.0 - share;
    air.air_temperature += back * (before.air_temperature - after.air_temperature);
    air.neutral += back * (before.neutral - after.neutral);
    air.instability += back * (before.instability - after.instability);
    air.heat_capacity += back * (before.heat_capacity - after.heat_capacity);
    air.vapour_pressure += back * (before.vapour_pressure - after.vapour_pressure);
    air.latent += back * (before.latent - after.latent);
    return air;
}

}  // namespace diurna
