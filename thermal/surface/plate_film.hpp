#pragma once

#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/cube_root.hpp"
#include "materials/matter/material.hpp"
#include "thermal/surface/film.hpp"

namespace diurna {

/// Free and forced convection of walls and bodies. The effect of a facet's position, tilt and size
/// is in a `NaturalFilm`, which is constant; the effect of the air in a `PlateAir`, the same for
/// all facets of a material at one instant. Films are products of both, so that neither is computed
/// for each facet and instant.
///
/// A body (BodyFilm), Ra of its size and |T_s − T_a|, Re of its size and wind, Pr = 0.71:
///
///     free     the largest of an upright plate under g sin(tilt), all Ra (Churchill & Chu 1975),
///                  Nu = (0.825 + 0.387 Ra^⅙ / [1 + (0.492/Pr)^(9/16)]^(8/27))²
///              and a level one under g |cos(tilt)|, of area over perimeter (McAdams 1954; Lloyd &
///              Moran 1974), hot side up or cold side down: the larger of 0.54 Ra^¼ and 0.15 Ra^⅓;
///              hot side down or cold side up: 0.27 Ra^¼
///              (inclined: Raithby & Hollands 1998, Handbook of Heat Transfer, 4.3)
///     cylinder (0.60 + 0.387 Ra^⅙ / [1 + (0.559/Pr)^(9/16)]^(8/27))² (Churchill & Chu 1975)
///     forced   plate: 0.664 Re^½ Pr^⅓ laminar, (0.037 Re^⅘ − A) Pr^⅓ beyond the transition, with
///              A such that it is continuous (Incropera et al., 7.2)
///     cylinder Churchill & Bernstein 1977, as a sum of two powers of Re: 1.5 % up to Re = 1e7
///     box      0.102 Re^0.675 Pr^⅓ (Jakob 1949: a square bar across the flow)
///     both     h³ = free³ + forced³ (Churchill 1977)
///
/// The air's properties are those at the mean of surface and air temperature (Eckert's reference
/// temperature in flight), to first order in the difference: 1 % at 60 K, 3 % at 300 K.
///
/// `Value` is a number, or one for each lane; `Own` likewise (AirFilmOf).
template <class Value, class Own>
struct PlateAirOf {
    Value conduct;    // √k [W^½ m^-½ K^-½]
    Value sixth;      // √third
    Value quarter;    // k (g β / ν α)^¼ [W m^-7/4 K^-5/4]
    Value third;      // k (g β / ν α)^⅓ [W m⁻² K⁻⁴ᐟ³]; of walls (ρ/ρ₀)^⅔
    Value laminar;    // forced, for a size of 1 m; of walls all of it [W m⁻² K⁻¹]
    Value turbulent;  // forced beyond the transition
    Value edge;       // reduction of it by the laminar part upstream
    Own warming;      // [K⁻¹] decrease of `third` per kelvin of the surface's excess
    double roughness = 1.0;  // of MoWiTT's walls
    bool quadratic = false;  // MoWiTT
};
using PlateAir = PlateAirOf<double, double>;

/// A facet's own factors of its film. At most eight numbers: arrays of them load as vectors.
struct NaturalFilm {
    double side = 1.0;  // 1: air rises from it if it is warmer, −1: if it is colder
    /// Of a level plate whose air rises; with stagnant air below or above it half of `quarter` and
    /// no `third`. Of walls `third` for rising air, `quarter` for stagnant air.
    double quarter = 0.0, third = 0.0;
    double conduct = 0.0, sixth = 0.0;  // of an upright plate
    /// Powers of its share of the wind and its size; of sheltered ground the share itself and the
    /// inverse of its square.
    double laminar = 1.0, turbulent = 1.0, edge = 0.0;
};

/// Size of a facet's part, and its share of the wind.
struct FilmPart {
    float rise = 0.0f;     // [m] along its slope; all 0: not known, as of a square of 1 m
    float breadth = 0.0f;  // [m] area over perimeter
    float chord = 0.0f;    // [m] along the wind, mean over all directions
    float across = 0.0f;   // [m] of the whole body: a cylinder's diameter, a box's width
    float wind = 1.0f;     // share of the measured wind
};

/// The facet's own factors of its film.
///
/// up_cosine  upward part of the outward normal, −1 to 1
NaturalFilm facet_film(const Convection& convection, double up_cosine, const FilmPart& part);

/// Natural convection of a building's surface, h = C |ΔT|^⅓ (Walton's TARP 1983): the factor C [W
/// m⁻² K⁻⁴ᐟ³] for rising air and for stagnant air. Both 1.31 for a wall.
NaturalFilm natural_film(double up_cosine);

/// The air's factors of a film. For walls scaled with its density ρ over ρ₀ = 1.204 kg m⁻³ (20
/// °C, 1013 hPa) of the measured formulas: natural ρ^⅔ as Ra^⅓, forced ρ^½ (TARP's √U),
/// ρ^0.89.
///
/// reference  air at the temperature of its properties: the air's, in flight
///            Eckert's
/// wind       [m s⁻¹]
PlateAir plate_air(const Tarp& tarp, const AirState& reference, double wind);
PlateAir plate_air(const Mowitt& mowitt, const AirState& reference, double wind);
PlateAir plate_air(const BodyFilm& body, const AirState& reference, double wind);

/// Forced part of TARP's film [W m⁻² K⁻¹]: 2.537 W_f R_f √(P U / A), mean of windward and leeward
/// (W_f 0.75), P/A = 4 / length; for a level surface (|up cosine| 0.98 or more) facet_film() uses
/// W_f 1, as Walton 1983 and EnergyPlus for roofs.
double tarp_forced(const Tarp& tarp, double wind_speed);
/// Forced part of DOE-2's MoWiTT film, windward: 3.26 U^0.89.
double mowitt_forced(double wind_speed);

/// Adiabatic temperature of a surface moving through the air: T (1 + r (γ − 1)/2 M²), γ = 1.4.
double recovery_temperature(double air_temperature, double speed, double recovery);
/// r of a plate: √Pr for a laminar boundary layer, up to the transition; ∛Pr for a turbulent one.
double recovery_factor(const AirState& air, const Flight& flight, double transition);

/// A wall under natural and forced convection: their sum (TARP) or natural + R_f (√(natural² +
/// forced²) − natural) (MoWiTT): (T7) of docs/theory.md.
[[gnu::always_inline]] inline Film wall_film(const PlateAir& air, const NaturalFilm& own,
                                             double excess) {
    const double risen = own.third, held = own.quarter;  // both loaded: no branch
    const double n =
        air.third * (excess * own.side > 0.0 ? risen : held) * cube_root(std::abs(excess));
    const double forced = air.laminar * own.laminar;
    if (!air.quadratic) return {n + forced, n / 3.0, 0.0};
    const double both = std::sqrt(n * n + forced * forced);
    const double h = n + air.roughness * (both - n);
    const double steep = both > 0.0 ? 1.0 + air.roughness * (n / both - 1.0) : 1.0;
    return {h, n * steep / 3.0, 0.0};
}

/// A body's film. Every part is a power of |excess| times one of the properties' share f of their
/// value at zero excess, so excess · dh/dT follows from the exponents. (T6) of docs/theory.md
[[gnu::always_inline]] inline Film body_film(const PlateAir& air, const NaturalFilm& own,
                                             double excess) {
    const double x = std::abs(excess);
    const double f = 1.0 / (1.0 + air.warming * excess), root_f = std::sqrt(f);
    const double fall = air.warming * excess * f;  // −excess d(ln f)/dT
    const double cube = cube_root(x), sixth = std::sqrt(cube), quarter = std::sqrt(std::sqrt(x));
    const double risen = air.sixth * own.sixth * sixth * root_f;
    const double root = air.conduct * own.conduct + risen;
    const double upright = root * root;
    const double upright_rise = risen * root * (1.0 / 3.0 - fall);
    const double rising = static_cast<double>(excess * own.side > 0.0);
    const double slow = air.quarter * own.quarter * (0.5 + 0.5 * rising) * quarter * root_f;
    const double fast = air.third * own.third * rising * cube * f;
    const double level = slow > fast ? slow : fast;
    const double level_rise = slow > fast ? slow * (0.25 - 0.5 * fall) : fast * (1.0 / 3.0 - fall);
    const double n = upright > level ? upright : level;
    const double n_rise = upright > level ? upright_rise : level_rise;
    const double laminar = air.laminar * own.laminar, quick = air.turbulent * own.turbulent * f;
    const double tripped = quick - air.edge * own.edge;
    const double forced = tripped > laminar ? tripped : laminar;
    const double forced_rise = tripped > laminar ? -fall * quick : 0.0;
    constexpr double least = 1e-30;  // for unused lanes
    const double h = cube_root(n * n * n + forced * forced * forced) + least;
    return {h, (n * n * n_rise + forced * forced * forced_rise) / (h * h), 0.0};
}

}  // namespace diurna
