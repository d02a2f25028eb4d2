#include "thermal/surface/plate_film.hpp"

#include <algorithm>
#include <variant>

#include "materials/air/transport.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double prandtl = 0.71;             // of air, 0.70 to 0.72 from 200 to 500 K
constexpr double reference_density = 1.204;  // [kg m⁻³] 20 °C, 1013 hPa
constexpr double property_exponent = 0.31;   // half of that by which `third` falls with T: −0.69,
                                             // and the turbulent plate's: −0.56
constexpr double cylinder_transition = 282000;  // Re of Churchill & Bernstein
// (1 + z^⅝)^⅘ ≈ 1 + 0.74 z^0.565, 1.5 % from zero to z = 35, z = Re / 282000
constexpr double cylinder_share = 0.74, cylinder_power = 0.565;
constexpr double box_power = 0.675;
constexpr double tarp_exposure = 0.75;  // W_f of a wall: mean of windward 1 and leeward 0.5
constexpr double tarp_level = 0.98;     // |up cosine| from which a surface counts as level

/// Of Churchill & Chu's Ra^⅙: 0.387 [1 + (p/Pr)^(9/16)]^(−8/27).
double sixth_root_factor(double p) {
    return 0.387 * std::pow(1.0 + std::pow(p / prandtl, 9.0 / 16.0), -8.0 / 27.0);
}

/// A part's sizes, of what is given: its own, a square's of the given length, or of 1 m.
FilmPart sized(FilmPart part, double length) {
    if (length <= 0.0 && part.chord > 0.0f) return part;
    const float side = length > 0.0 ? float(length) : 1.0f;
    part.rise = part.chord = part.across = side;
    part.breadth = 0.25f * side;
    return part;
}

NaturalFilm free_plate(double up_cosine, const FilmPart& part) {
    const double level = std::min(1.0, std::abs(up_cosine));
    const double upright = std::sqrt(std::max(0.0, 1.0 - level * level));
    NaturalFilm film;
    // (T4) of docs/theory.md
    film.conduct = 0.825 / std::sqrt(double{part.rise});
    film.sixth = sixth_root_factor(0.492) * std::pow(upright, 1.0 / 6.0);
    film.side = up_cosine >= 0.0 ? 1.0 : -1.0;
    film.quarter = 0.54 * std::pow(level / part.breadth, 0.25);
    film.third = 0.15 * std::cbrt(level);
    return film;
}

NaturalFilm body_part(const BodyFilm& body, double up_cosine, const FilmPart& given) {
    const FilmPart part = sized(given, body.length);
    const double wind = part.wind, chord = part.chord, across = part.across;
    if (body.shape == BodyShape::cylinder) {
        return {.conduct = 0.60 / std::sqrt(across),
                .sixth = sixth_root_factor(0.559),
                .laminar = std::sqrt(wind / across),
                .turbulent = std::pow(wind * across, 0.5 + cylinder_power) / across,
                .edge = std::sqrt(wind / across)};
    }
    NaturalFilm film = free_plate(up_cosine, part);
    if (body.shape == BodyShape::box) {
        film.laminar = 0.0;
        film.turbulent = std::pow(wind * across, box_power) / across;
        return film;
    }
    film.laminar = std::sqrt(wind / chord);
    film.turbulent = std::pow(wind * chord, 0.8) / chord;
    film.edge = 1.0 / chord;
    return film;
}

double density_share(const AirState& air) { return air_density(air) / reference_density; }

}  // namespace

NaturalFilm natural_film(double up_cosine) {
    const double cosine = std::min(1.0, std::abs(up_cosine));
    return {.side = up_cosine >= 0.0 ? 1.0 : -1.0,
            .quarter = 1.81 / (1.382 + cosine),
            .third = 9.482 / (7.238 - cosine)};
}

NaturalFilm facet_film(const Convection& convection, double up_cosine, const FilmPart& part) {
    if (const auto* body = std::get_if<BodyFilm>(&convection)) {
        return body_part(*body, up_cosine, part);
    }
    NaturalFilm film = natural_film(up_cosine);
    if (std::holds_alternative<Tarp>(convection)) {
        // A level surface has no lee: it is all windward (EnergyPlus, Engineering Reference).
        const double exposed = std::abs(up_cosine) >= tarp_level ? 1.0 / tarp_exposure : 1.0;
        film.laminar = exposed * std::sqrt(double{part.wind});
    } else if (std::holds_alternative<Mowitt>(convection)) {
        film.laminar = std::pow(double{part.wind}, 0.89);
    } else {
        film.laminar = part.wind;
        film.turbulent = 1.0 / (film.laminar * film.laminar);
    }
    return film;
}

PlateAir plate_air(const Tarp& tarp, const AirState& reference, double wind) {
    const double share = density_share(reference);
    PlateAir air{};
    air.third = std::cbrt(share * share);
    air.laminar = tarp_forced(tarp, wind) * std::sqrt(share);
    return air;
}

PlateAir plate_air(const Mowitt& mowitt, const AirState& reference, double wind) {
    const double share = density_share(reference);
    PlateAir air{};
    air.third = std::cbrt(share * share);
    air.laminar = mowitt_forced(wind) * std::pow(share, 0.89);
    air.roughness = mowitt.roughness;
    air.quadratic = true;
    return air;
}

PlateAir plate_air(const BodyFilm& body, const AirState& reference, double wind) {
    const double t = reference.temperature, k = air_conductivity(t),
                 density = air_density(reference);
    const double viscosity = air_viscosity(t) / density;
    const double diffusivity = k / (density * dry_air_heat_capacity);
    const double buoyancy = gravity / (t * viscosity * diffusivity);  // Ra of 1 m and 1 K
    const double reynolds = wind / viscosity;                         // of 1 m
    const double root_prandtl = std::cbrt(prandtl);
    PlateAir air{};
    air.conduct = std::sqrt(k);
    air.third = k * std::cbrt(buoyancy);
    air.sixth = std::sqrt(air.third);
    air.quarter = k * std::sqrt(std::sqrt(buoyancy));
    air.warming = property_exponent / t;
    // (T5) of docs/theory.md
    switch (body.shape) {
        case BodyShape::plate:
            air.laminar = 0.664 * root_prandtl * k * std::sqrt(reynolds);
            air.turbulent = 0.037 * root_prandtl * k * std::pow(reynolds, 0.8);
            air.edge =
                (0.037 * std::pow(body.transition, 0.8) - 0.664 * std::sqrt(body.transition)) *
                root_prandtl * k;
            break;
        case BodyShape::cylinder: {
            const double slow =
                0.62 * root_prandtl * k * std::pow(1.0 + std::pow(0.4 / prandtl, 2.0 / 3.0), -0.25);
            air.laminar = slow * std::sqrt(reynolds);
            air.turbulent = slow * cylinder_share * std::pow(cylinder_transition, -cylinder_power) *
                            std::pow(reynolds, 0.5 + cylinder_power);
            air.edge = -air.laminar;  // both add up
            break;
        }
        case BodyShape::box:
            air.turbulent = 0.102 * root_prandtl * k * std::pow(reynolds, box_power);
            break;
    }
    return air;
}

double tarp_forced(const Tarp& tarp, double wind_speed) {
    return 2.537 * tarp_exposure * tarp.roughness * std::sqrt(4.0 / tarp.length * wind_speed);
}

double mowitt_forced(double wind_speed) { return 3.26 * std::pow(wind_speed, 0.89); }

double recovery_temperature(double air_temperature, double speed, double recovery) {
    // (T10) of docs/theory.md
    constexpr double gamma = 1.4;
    const double mach_squared = speed * speed / (gamma * dry_air_gas_constant * air_temperature);
    return air_temperature * (1.0 + recovery * 0.5 * (gamma - 1.0) * mach_squared);
}

double recovery_factor(const AirState& air, const Flight& flight, double transition) {
    const double reynolds =
        flight.speed * flight.length * air_density(air) / air_viscosity(air.temperature);
    const double laminar = reynolds > transition ? transition / reynolds : 1.0;
    return laminar * std::sqrt(prandtl) + (1.0 - laminar) * std::cbrt(prandtl);
}

}  // namespace diurna
