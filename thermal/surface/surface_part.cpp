#include "thermal/surface/surface_part.hpp"

#include <algorithm>

#include "materials/base/units.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/stored_flux.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

/// The film between a part and the air: the open air's, through leaves, or sheltered by them.
Film film_above(const SurfaceConditions& c, const SurfacePart& part, double t) {
    Film film = film_of(c.air, c.natural, t);
    if (film.h < part.least_film) film = {part.least_film, 0.0, 0.0};
    if (part.leaf_film > 0.0) {
        // In series, and all of the leaves' faces on the part of the ground they cover.
        const double share = part.leaf_film / (film.h + part.leaf_film);
        film = {film.h * share / part.cover, film.rise * share * share / part.cover,
                film.slope * share * share / part.cover};
    }
    const double open = 1.0 - part.shelter;
    return {open * film.h + part.shelter * part.soil_film, open * film.rise, open * film.slope};
}

}  // namespace

SurfacePart whole_ground(const SurfaceConditions& c) {
    return {.cover = 1.0,
            .solar = c.absorbed_solar,
            .internal = c.internal,
            .resistance = c.air.resistance,
            .wetness = c.air.wetness};
}

PartTerms part_terms(const SurfaceConditions& c, const SurfacePart& part, double t) {
    const Film film = film_above(c, part, t);
    // Ground as warm as itself fills what is not sky.
    const double self = 1.0 - c.own_view * (1.0 - c.emissivity);
    const DryLoss dry = dry_loss(c.air, film, c.emissivity * stefan_boltzmann, t);
    const double black = stefan_boltzmann * power4(t);
    const double incoming =
        self > 0.0 ? (c.longwave_in + c.own_view * c.emissivity * black) / self : black;
    const double incoming_slope = self > 0.0 ? c.own_view * c.emissivity / self : 1.0;
    PartTerms e{};
    e.solar = part.solar;
    e.longwave_in = part.cover * c.emissivity * incoming;
    e.longwave_out = -part.cover * dry.emitted;
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
    const SurfaceFlux melt = melting_flux(c.phase_film, c.frost_heat, c.water_heat, t);
    e.melt = part.cover * melt.flux;
    e.flux =
        e.solar + e.longwave_in + e.longwave_out + e.sensible + e.latent + e.melt + part.internal;
    e.slope =
        part.cover * (4.0 * stefan_boltzmann * t * t * t * c.emissivity * (incoming_slope - 1.0) -
                      film.h - film.rise + melt.slope) +
        latent_slope;
    return e;
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

}  // namespace diurna
