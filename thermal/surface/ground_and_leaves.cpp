#include "thermal/surface/ground_and_leaves.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

constexpr double melting_point = zero_celsius;
constexpr double phase_film = 50.0;    // [W m⁻² K⁻¹] between a surface and its frost or water
constexpr double freezing_span = 2.0;  // [K] over which vapour's heat turns to that of ice

/// Saturation pressure over ice below the triple point, where the two meet, over water above;
/// and its slope.
double saturation_over(double temperature, double& slope) {
    constexpr double a = 21.8745584, b = 7.66, triple = 273.16;
    if (temperature >= triple) return vapour_pressure_of(temperature, slope);
    const double t = std::max(temperature, 100.0), inverse = 1.0 / (t - b);
    const double pressure = 610.78 * std::exp(a * (t - triple) * inverse);
    slope = pressure * a * (triple - b) * inverse * inverse;
    return pressure;
}

struct PartTerms {
    double solar, longwave_in, longwave_out, sensible, latent, wet_latent, melt, flux, slope;
};

/// A surface of share `cover` of the ground; fluxes per unit ground. `skies` is the share of it
/// open to the sky (and to its own kind), `other` the longwave that comes from elsewhere.
struct Part {
    double cover = 1.0;
    double solar = 0.0;
    double internal = 0.0;
    double resistance = 0.0, wetness = 0.0;
    double sides = 1.0;       // that radiate
    double other = 0.0;       // [W m⁻²] absorbed longwave from the other part
    double shelter = 0.0;     // share of it that leaves keep from the open air's film
    double soil_film = 0.0;   // [W m⁻² K⁻¹] of the sheltered share
    double least_film = 0.0;  // [W m⁻² K⁻¹] of leaves, whatever lies still above them
    double leaf_film = 0.0;   // [W m⁻² K⁻¹] of all leaves' boundary layers, per unit ground
};

PartTerms part_terms(const SurfaceConditions& c, const Part& part, double t) {
    Film film = film_of(c.air, c.natural, t);
    if (film.h < part.least_film) film = {part.least_film, 0.0, 0.0};
    if (part.leaf_film > 0.0) {
        // In series, and all of the leaves' faces on the part of the ground they cover.
        const double share = part.leaf_film / (film.h + part.leaf_film);
        film = {film.h * share / part.cover, film.rise * share * share / part.cover,
                film.slope * share * share / part.cover};
    }
    const double open = 1.0 - part.shelter;
    film = {open * film.h + part.shelter * part.soil_film, open * film.rise, open * film.slope};
    // Ground as warm as itself fills what is not sky.
    const double self = 1.0 - c.own_view * (1.0 - c.emissivity);
    const DryLoss dry = dry_loss(c.air, film, c.emissivity * stefan_boltzmann, t);
    const double black = stefan_boltzmann * power4(t);
    const double incoming =
        self > 0.0 ? (c.longwave_in + c.own_view * c.emissivity * black) / self : black;
    const double incoming_slope = self > 0.0 ? c.own_view * c.emissivity / self : 1.0;
    PartTerms e{};
    e.solar = part.solar;
    e.longwave_in = part.cover * c.emissivity * incoming + part.other;
    e.longwave_out = -part.cover * part.sides * dry.emitted;
    e.sensible = -part.cover * dry.sensible;
    double latent_slope = 0.0;
    const bool evaporates = part.wetness > 0.0 || c.stores || c.wet_share > 0.0;
    if (evaporates) {
        const LatentHeat free = latent_heat_or_frost(c.air, film, 1.0, 0.0, t);
        const LatentHeat held = latent_heat_or_frost(c.air, film, part.wetness, part.resistance, t);
        e.wet_latent = part.cover * free.flux;
        e.latent = part.cover * (c.wet_share * free.flux + (1.0 - c.wet_share) * held.flux);
        latent_slope = part.cover * (c.wet_share * free.slope + (1.0 - c.wet_share) * held.slope);
    }
    const double thaw = t - melting_point;
    e.melt = -part.cover * std::clamp(phase_film * thaw, -c.water_heat, c.frost_heat);
    const bool turning = phase_film * thaw > -c.water_heat && phase_film * thaw < c.frost_heat;
    e.flux =
        e.solar + e.longwave_in + e.longwave_out + e.sensible + e.latent + e.melt + part.internal;
    e.slope = part.cover * (4.0 * stefan_boltzmann * t * t * t * c.emissivity *
                                (incoming_slope - part.sides) -
                            film.h - film.rise - (turning ? phase_film : 0.0)) +
              latent_slope;
    return e;
}

/// The film at which stable air carries most heat [W m⁻² K⁻¹]: colder, Louis's film falls faster
/// than the difference grows. Ground has its own heat to hold it; leaves have none and would jump
/// between two temperatures, so their film, a boundary layer of their own, falls no further.
/// There 15 s y² = √(1 + 30 y), in the notation of LouisForm.
double fullest_film(const AirFilm& air) {
    if (air.plate || air.instability <= 0.0 || air.s <= 0.0) return 0.0;
    double y = 0.1;
    for (int i = 0; i < 8; ++i) y = std::sqrt(std::sqrt(1.0 + 30.0 * y) / (15.0 * air.s));
    return air.neutral / (1.0 + air.s * y * std::sqrt(1.0 + 30.0 * y)) + air.least;
}

/// The root of a falling function between 1 and 5000 K.
template <class Function>
double root_of(const Function& function, double guess) {
    double low = 1.0, high = 5000.0, at = std::clamp(guess, 2.0, 4000.0);
    for (int i = 0; i < 120; ++i) {
        const BoundaryFlux f = function(at);
        (f.flux > 0.0 ? low : high) = at;
        double next = f.slope < 0.0 ? at - f.flux / f.slope : low;
        if (!(next > low && next < high) || i > 50) next = 0.5 * (low + high);
        const double moved = std::abs(next - at);
        at = next;
        if (moved < 1e-11) break;
    }
    return at;
}

void add(const PartTerms& e, SurfaceTerms& terms) {
    terms.balance.absorbed_solar += e.solar;
    terms.balance.longwave_in += e.longwave_in;
    terms.balance.longwave_out += e.longwave_out;
    terms.balance.sensible += e.sensible;
    terms.balance.latent += e.latent;
    terms.wet_evaporation += e.wet_latent;
    terms.frost_melt += e.melt;
}

}  // namespace

LatentHeat latent_heat_or_frost(const AirFilm& air, const Film& film, double wetness,
                                double resistance, double temperature) {
    double slope;
    const double excess = saturation_over(temperature, slope) - air.vapour_pressure;
    const bool drying = excess > 0.0;
    const double r = drying ? resistance : 0.0;
    const double frozen = std::clamp((melting_point - temperature) / freezing_span, 0.0, 1.0);
    const double over_ice = latent_heat_of_sublimation(air.air_temperature) /
                            latent_heat_of_vaporisation(air.air_temperature);
    const double heat = air.latent * (1.0 + frozen * (over_ice - 1.0));
    const bool blends = frozen > 0.0 && frozen < 1.0;
    const double heat_slope = blends ? -air.latent * (over_ice - 1.0) / freezing_span : 0.0;
    const double wet = drying ? wetness : 1.0;
    const double in_series = 1.0 / (air.heat_capacity + r * film.h);
    const double conductance = film.h * in_series;
    const double steeper = air.heat_capacity * in_series * in_series * film.slope;
    return {-wet * heat * conductance * excess,
            -wet * (heat * (conductance * slope + steeper * excess) +
                    heat_slope * conductance * excess)};
}

double latent_heat_of_sublimation(double temperature) {
    const double t = std::clamp(temperature - melting_point, -100.0, 0.0);
    return 2.8341e6 - 290.0 * t - 4.0 * t * t;
}

double heat_of_vapour(double air_temperature, double surface_temperature) {
    const double frozen =
        std::clamp((melting_point - surface_temperature) / freezing_span, 0.0, 1.0);
    return std::lerp(latent_heat_of_vaporisation(air_temperature),
                     latent_heat_of_sublimation(air_temperature), frozen);
}

double recovery_temperature(double air_temperature, double speed) {
    constexpr double gamma = 1.4, recovery = 0.89;
    const double mach_squared = speed * speed / (gamma * dry_air_gas_constant * air_temperature);
    return air_temperature * (1.0 + recovery * 0.5 * (gamma - 1.0) * mach_squared);
}

SurfaceTerms surface_terms(const SurfaceConditions& c, double ground) {
    SurfaceTerms terms{};
    terms.balance.internal = c.internal;
    terms.radiometric = terms.leaf = ground;
    const Part whole{.cover = 1.0,
                     .solar = c.absorbed_solar,
                     .internal = c.internal,
                     .resistance = c.air.resistance,
                     .wetness = c.air.wetness};
    if (std::holds_alternative<std::monostate>(c.canopy)) {
        const PartTerms e = part_terms(c, whole, ground);
        add(e, terms);
        terms.into_ground = e.flux;
        terms.into_ground_slope = e.slope;
        return terms;
    }
    const double least_film = fullest_film(c.air);
    if (const auto* leaf = std::get_if<BigLeaf>(&c.canopy)) {
        const double joined = leaf->skin_conductance;
        Part leaves = whole;
        leaves.least_film = least_film;
        const double skin = root_of(
            [&](double t) {
                const PartTerms e = part_terms(c, leaves, t);
                return BoundaryFlux{e.flux - joined * (t - ground), e.slope - joined};
            },
            ground);
        const PartTerms e = part_terms(c, leaves, skin);
        add(e, terms);
        terms.radiometric = terms.leaf = skin;
        terms.into_ground = joined * (skin - ground);
        terms.into_ground_slope = joined * (joined / (joined - e.slope) - 1.0);
        return terms;
    }
    // Leaves above, ground between: both open to the sky by their share of the view from above, and
    // facing one another over the leaves' share.
    const auto& two = std::get<TwoSource>(c.canopy);
    const double cover = 1.0 - std::exp(-0.5 * two.leaf_area);
    const double between = c.emissivity * c.emissivity * stefan_boltzmann * cover;
    // Norman et al. 1995, eq. B.1: resistance above soil 1 / (0.004 + 0.012 u), u near the ground
    // from the logarithmic profile over 1 cm of roughness, stilled by the leaves (their eq. B.4).
    const double near_ground = c.wind_speed * std::log(0.1 / 0.01) /
                               std::log(std::max(c.wind_height, 0.2) / 0.01) *
                               std::exp(-0.28 * std::pow(two.leaf_area, 2.0 / 3.0));
    const double soil_film = c.air.heat_capacity * (0.004 + 0.012 * near_ground);
    // Their eq. A.8: the leaves' own resistance 90/F √(l/u), leaves of 5 cm, the wind among them a
    // third of that above.
    const double leaf_film = c.air.heat_capacity * two.leaf_area / 90.0 *
                             std::sqrt(std::max(c.wind_speed, least_wind) / 3.0 / 0.05);
    SurfaceConditions dry = c;
    dry.frost_heat = dry.water_heat = 0.0;
    const Part canopy{.cover = cover,
                      .solar = cover * c.absorbed_solar,
                      .internal = 0.0,
                      .resistance = two.leaf_resistance,
                      .wetness = 1.0,
                      .sides = 1.0,
                      .least_film = least_film,
                      .leaf_film = leaf_film};
    const auto exchanged = [&](double leaf) { return between * (power4(leaf) - power4(ground)); };
    const auto leaf_balance = [&](double t) {
        const PartTerms e = part_terms(dry, canopy, t);
        return BoundaryFlux{e.flux - exchanged(t), e.slope - 4.0 * between * t * t * t};
    };
    const double leaf = root_of(leaf_balance, ground);
    const PartTerms leaves = part_terms(dry, canopy, leaf);
    const Part soil{.cover = 1.0 - cover,
                    .solar = (1.0 - cover) * c.absorbed_solar,
                    .internal = c.internal,
                    .resistance = c.air.resistance,
                    .wetness = c.air.wetness,
                    .sides = 1.0,
                    .other = 0.0,
                    .shelter = cover,
                    .soil_film = soil_film};
    SurfaceConditions under = c;
    under.wet_share = 0.0;
    under.stores = false;
    const PartTerms earth = part_terms(under, soil, ground);
    add(leaves, terms);
    add(earth, terms);
    const double passed = 4.0 * between * leaf * leaf * leaf;
    const double own = 4.0 * between * ground * ground * ground;
    const double leaf_slope = leaves.slope - passed;  // of the leaf's balance
    const double follows = -own / leaf_slope;         // dT_leaf / dT_ground
    terms.leaf = leaf;
    terms.radiometric = std::pow(cover * power4(leaf) + (1.0 - cover) * power4(ground), 0.25);
    terms.into_ground = earth.flux + exchanged(leaf);
    terms.into_ground_slope = earth.slope - own + passed * follows;
    return terms;
}

}  // namespace diurna
