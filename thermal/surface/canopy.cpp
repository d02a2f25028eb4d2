#include "thermal/surface/canopy.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/surface/surface_flux.hpp"
#include "thermal/surface/surface_part.hpp"

namespace diurna {

namespace {

/// The root of a falling function between 1 and 5000 K.
template <class Function>
double root_of(const Function& function, double guess) {
    double low = 1.0, high = 5000.0, at = std::clamp(guess, 2.0, 4000.0);
    for (int i = 0; i < 120; ++i) {
        const SurfaceFlux f = function(at);
        (f.flux > 0.0 ? low : high) = at;
        double next = f.slope < 0.0 ? at - f.flux / f.slope : low;
        if (!(next > low && next < high) || i > 50) next = 0.5 * (low + high);
        const double moved = std::abs(next - at);
        at = next;
        if (moved < 3e-13) break;
    }
    return at;
}

/// Film above soil under leaves [W m⁻² K⁻¹]. Norman et al. 1995, eq. B.1: resistance
/// 1 / (0.004 + 0.012 u), u near the ground from the logarithmic profile over 1 cm of roughness,
/// stilled by the leaves (their eq. B.4).
double sheltered_film(const SurfaceConditions& c, double leaf_area) {
    const double near_ground = c.wind_speed * std::log(0.1 / 0.01) /
                               std::log(std::max(c.wind_height, 0.2) / 0.01) *
                               std::exp(-0.28 * std::pow(leaf_area, 2.0 / 3.0));
    return c.air.heat_capacity * (0.004 + 0.012 * near_ground);
}

/// Film of all leaves' boundary layers [W m⁻² K⁻¹]. Their eq. A.8: the leaves' own resistance
/// 90/F √(l/u), leaves of 5 cm, the wind among them a third of that above.
double leaves_film(const SurfaceConditions& c, double leaf_area) {
    return c.air.heat_capacity * leaf_area / 90.0 *
           std::sqrt(std::max(c.wind_speed, least_wind) / 3.0 / 0.05);
}

}  // namespace

double fullest_film(const AirFilm& air, const NaturalFilm& own) {
    if (air.instability <= 0.0 || air.s <= 0.0) return 0.0;
    return neutral_film(air, own) * fullest_share(air) + air.least;
}

double fullest_share(const AirFilm& air) {
    if (air.s <= 0.0) return 0.0;
    double y = 0.1;
    for (int i = 0; i < 8; ++i) y = std::sqrt(std::sqrt(1.0 + 30.0 * y) / (15.0 * air.s));
    y = std::min(y, stable_limit);
    return 1.0 / (1.0 + air.s * y * std::sqrt(1.0 + 30.0 * y));
}

SurfaceTerms skin_terms(const SurfaceConditions& c, double joined, double ground) {
    SurfacePart leaves = whole_ground(c);
    leaves.least_film = fullest_film(c.air, c.natural);
    const double skin = root_of(
        [&](double t) {
            const PartTerms e = part_terms(c, leaves, t);
            return SurfaceFlux{e.flux - joined * (t - ground), e.slope - joined};
        },
        ground);
    const PartTerms e = part_terms(c, leaves, skin);
    SurfaceTerms terms{};
    terms.balance.internal = c.internal;
    add(e, terms);
    terms.radiometric = terms.leaf = skin;
    // What it conducts: joined (skin − ground), whose digits a stiff joint would lose.
    terms.into_ground = e.flux;
    terms.into_ground_slope = joined * (joined / (joined - e.slope) - 1.0);
    return terms;
}

SurfaceTerms two_source_terms(const SurfaceConditions& c, const TwoSource& two, double ground) {
    const double cover = 1.0 - std::exp(-0.5 * two.leaf_area);
    const double between = c.emissivity * c.emissivity * stefan_boltzmann * cover;
    const auto exchanged = [&](double leaf) { return between * (power4(leaf) - power4(ground)); };
    SurfaceConditions dry = c;
    dry.frost_heat = dry.water_heat = 0.0;
    const SurfacePart canopy{.cover = cover,
                             .solar = cover * c.absorbed_solar,
                             .internal = 0.0,
                             .resistance = two.leaf_resistance,
                             .wetness = 1.0,
                             .least_film = fullest_film(c.air, c.natural),
                             .leaf_film = leaves_film(c, two.leaf_area)};
    const auto leaf_balance = [&](double t) {
        const PartTerms e = part_terms(dry, canopy, t);
        return SurfaceFlux{e.flux - exchanged(t), e.slope - 4.0 * between * t * t * t};
    };
    const double leaf = root_of(leaf_balance, ground);
    const PartTerms leaves = part_terms(dry, canopy, leaf);
    SurfaceConditions under = c;
    under.wet_share = 0.0;
    under.stores = false;
    const SurfacePart soil{.cover = 1.0 - cover,
                           .solar = (1.0 - cover) * c.absorbed_solar,
                           .internal = c.internal,
                           .resistance = c.air.resistance,
                           .wetness = c.air.wetness,
                           .shelter = cover,
                           .soil_film = sheltered_film(c, two.leaf_area)};
    const PartTerms earth = part_terms(under, soil, ground);
    const double passed = 4.0 * between * leaf * leaf * leaf;
    const double own = 4.0 * between * ground * ground * ground;
    const double leaf_slope = leaves.slope - passed;  // of the leaf's balance
    const double follows = -own / leaf_slope;         // dT_leaf / dT_ground
    SurfaceTerms terms{};
    terms.balance.internal = c.internal;
    add(leaves, terms);
    add(earth, terms);
    terms.leaf = leaf;
    terms.radiometric = std::pow(cover * power4(leaf) + (1.0 - cover) * power4(ground), 0.25);
    terms.into_ground = earth.flux + exchanged(leaf);
    terms.into_ground_slope = earth.slope - own + passed * follows;
    return terms;
}

}  // namespace diurna
