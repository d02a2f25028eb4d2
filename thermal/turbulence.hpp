#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/air.hpp"
#include "materials/material.hpp"

namespace diurna {

/// Bulk transfer of heat between ground and air after Monin and Obukhov, in Louis's closed form
/// (1979): the neutral coefficient times a function of the bulk Richardson number alone,
///
///     h = ρ cp k² U / (L_m L_h) · F(x),      x = −Ri = g z_u (T_s − T_a) / (T_a U²)
///     F = 1 + a x / (1 + c √x)               ground warmer than the air
///     F = 1 / (1 + s y √(1 + 30 y)), y = −x  ground colder; its long tail has one root only
///
/// with L_m = ln(z_u / z0), L_h = ln(z_t / z0h). a, c and s belong to the heights and roughness
/// lengths: s is the exact slope at neutrality, a and c are fitted once to Businger and Dyer's
/// functions over −10 < z/L < −0.001, to 2-6 % of their iterated solution (tests/turbulence_test).
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

AirFilm air_film(const ThermalSurface& surface, const LouisForm& louis, const AirState& air,
                 double wind_speed);

/// Saturation vapour pressure by cubic Hermite interpolation of materials/air.hpp between 150 and
/// 450 K (relative error below 1e-8 above 200 K), continued in a straight line beyond, so that a
/// surface hotter than boiling stays finite. For loops over lanes: no call, no branch.
class VapourTable {
 public:
    VapourTable();
    /// [Pa] and, through `slope`, [Pa K⁻¹].
    double operator()(double temperature, double& slope) const {
        const double x = std::clamp((temperature - first) / step, 0.0, double(count) - 1e-9);
        const int i = static_cast<int>(x);
        const double t = x - i;
        const double p = value_[i], q = value_[i + 1], m = slope_[i] * step,
                     n = slope_[i + 1] * step;
        const double third = m + n - 2.0 * (q - p), second = 3.0 * (q - p) - 2.0 * m - n;
        slope = (m + t * (2.0 * second + t * 3.0 * third)) / step;
        return p + t * (m + t * (second + t * third)) + slope * (temperature - first - x * step);
    }

 private:
    static constexpr double first = 150.0, step = 0.5;
    static constexpr int count = 600;
    std::array<double, count + 1> value_, slope_;
};
const VapourTable& vapour_table();

/// A film between surface and air [W m⁻² K⁻¹], and (T_s − T_a) dh/dT_s, which stays finite where
/// the two are equally warm.
struct Film {
    double h, rise;
};

/// Ground (Louis) or constant film.
inline Film ground_film(const AirFilm& air, double temperature) {
    const double x = air.instability * (temperature - air.air_temperature);
    const double warm = std::max(x, 0.0), cold = std::max(-x, 0.0);
    const double root = std::sqrt(warm), below = 1.0 / (1.0 + air.c * root);
    const double tail = std::sqrt(1.0 + 30.0 * cold), held = 1.0 / (1.0 + air.s * cold * tail);
    const bool unstable = x > 0.0;
    const double f = unstable ? 1.0 + air.a * warm * below : held;
    const double df = unstable ? air.a * (1.0 + 0.5 * air.c * root) * below * below
                               : air.s * held * held * (1.0 + 45.0 * cold) / tail;
    return {air.neutral * f, air.neutral * df * x};
}

/// A plate under natural and forced convection: their sum (TARP) or their root sum of squares
/// (MoWiTT).
inline Film plate_film(const AirFilm& air, NaturalFilm natural, double temperature) {
    const double excess = temperature - air.air_temperature;
    const double n = (excess > 0.0 ? natural.warm : natural.cold) * std::cbrt(std::abs(excess));
    if (!air.quadratic) return {n + air.neutral, n / 3.0};
    const double h = std::sqrt(n * n + air.neutral * air.neutral);
    return {h, h > 0.0 ? n * n / (3.0 * h) : 0.0};
}

/// Latent heat towards the surface [W m⁻²] and d/dT_s: evaporation from the wet share against the
/// surface's resistance in series with the air's, dew against the air's alone.
struct LatentHeat {
    double flux, slope;
};
inline LatentHeat latent_heat(const AirFilm& air, const VapourTable& table, Film film,
                              double temperature) {
    double slope;
    const double excess = table(temperature, slope) - air.vapour_pressure;
    const bool drying = excess > 0.0;
    const double resistance = drying ? air.resistance : 0.0;
    const double share = air.latent * (drying ? air.wetness : 1.0);
    const double in_series = 1.0 / (air.heat_capacity + resistance * film.h);
    const double conductance = film.h * in_series;
    const double difference = temperature - air.air_temperature;
    const double dh = std::abs(difference) > 1e-3 ? film.rise / difference : 0.0;
    const double steeper = air.heat_capacity * in_series * in_series * dh;
    return {-share * conductance * excess, -share * (conductance * slope + steeper * excess)};
}

}  // namespace diurna
