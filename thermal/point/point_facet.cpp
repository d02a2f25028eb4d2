#include "thermal/point/point_facet.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/base/units.hpp"
#include "thermal/point/schedule_clock.hpp"
#include "thermal/surface/standing_water.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

Bottom bottom_of(const ThermalSurface& surface) {
    // Behind a plate stands air; the grid then ends free.
    return surface.back ? Bottom{FixedFlux{0.0}} : surface.bottom;
}

}  // namespace

/// Fine enough for a minute's shock on a dry half-space, and never cut off: the span may be a year.
/// A front of melting halts at every node it crosses, so water is cut less finely.
GridOptions point_grid(const ThermalSurface& surface) {
    const bool wet = std::any_of(surface.layers.begin(), surface.layers.end(), [](const Layer& l) {
        return std::holds_alternative<Freezing>(l.law) || std::holds_alternative<Melting>(l.law);
    });
    return {.first = wet ? 0.005 : 0.001, .growth = wet ? 0.1 : 0.055, .deepest = 1e9};
}

PointFacet::PointFacet(PointSetup setup)
    : column(setup.surface.layers, bottom_of(setup.surface), setup.reference, setup.grid),
      u(column.size(), 0.0),
      setup_(std::move(setup)),
      rest_(u.size(), 0.0),
      capacity_(store_capacity(setup_.surface.store, setup_.up_cosine)),
      snow_albedo_(new_snow_albedo(setup_.surface)) {}

double new_snow_albedo(const ThermalSurface& surface) {
    return surface.snow_albedo ? surface.albedo : AgeingAlbedo{}.fresh;
}

SurfaceConditions PointFacet::conditions(Instant when, const Standing& lying,
                                         double snow_albedo) const {
    const PointForcing forcing = setup_.forcing(when);
    const ThermalSurface& surface = setup_.surface;
    const bool leaves = !std::holds_alternative<std::monostate>(surface.canopy);
    const SnowCover cover = capacity_.any() && !leaves && !surface.snow_albedo
                                ? snow_cover(lying.frost, surface.roughness_length)
                                : SnowCover{};
    // Measured light up over light down is the surface's albedo, wet or not.
    double albedo = forcing.albedo;
    if (std::isnan(albedo)) {
        albedo = surface.snow_albedo ? snow_albedo : surface.albedo;
        if (capacity_.any() && surface.store.wet_albedo >= 0.0) {
            const double wet = std::min(1.0, lying.water / capacity_.water_mm);
            albedo += wet * (surface.store.wet_albedo - albedo);
        }
        albedo += cover.share * (snow_albedo - albedo);
    }
    const double sunlight = forcing.sunlight + albedo * forcing.own_light;
    SurfaceConditions c;
    c.air = air_film(surface, setup_.louis, forcing.air, forcing.wind_speed);
    c.natural = facet_film(surface.convection, setup_.up_cosine, setup_.part);
    if (setup_.part.wind != 1.0f && std::holds_alternative<Louis>(surface.convection)) {
        c.air.kind = FilmKind::sheltered_ground;
    }
    c.wind_speed = forcing.wind_speed * setup_.part.wind;
    c.wind_height = setup_.wind_height;
    // Snow on a pane takes what would have passed.
    const double passed = (1.0 - cover.share) * surface.solar_transmittance;
    c.absorbed_solar = std::max(0.0, 1.0 - albedo - passed) * sunlight;
    c.longwave_in = forcing.longwave_in;
    c.own_view = forcing.own_view;
    c.emissivity = surface.emissivity;
    c.internal =
        scheduled(surface.internal_schedule, surface.internal_heat, setup_.utc_offset, when);
    c.rain_mm_h = std::max(0.0, forcing.rain_mm_h);
    c.stores = capacity_.any();
    c.snow_conductance = cover.conductance;
    c.phase_film = cover.phase_film;
    c.canopy = surface.canopy;
    return c;
}

SurfaceTerms PointFacet::terms(Instant when) const {
    SurfaceConditions c = conditions(when, standing, snow_albedo_);
    c.wet_share = mean_wet_share(standing.water + standing.frost, 0.0, 0.0, capacity_.water_mm);
    if (c.snow_conductance > 0.0) c.frost_heat = melts_at_once;
    return surface_terms(c, column.temperature(0, u[0]));
}

/// What each end of the column meets at the two stages of a step; the references must live.
PointFacet::Ends PointFacet::ends(const std::array<SurfaceConditions, 2>& c,
                                  const std::array<Instant, 2>& when) const {
    Ends ends;
    const auto* room = std::get_if<Interior>(&setup_.surface.bottom);
    for (std::size_t k = 0; k < 2; ++k) {
        ends.top[k] = [&at = c[k]](double t) {
            const SurfaceTerms terms = surface_terms(at, t);
            return BoundaryFlux{terms.into_ground, terms.into_ground_slope};
        };
        if (setup_.surface.back) {
            const double emissivity = setup_.surface.back->emissivity;
            const double arriving =
                setup_.behind ? setup_.behind(when[k]) : absorbed_of_air(c[k].air, emissivity);
            ends.back[k] = [&air = c[k].air, front = c[k].natural,
                            face = BackFace{emissivity, arriving, setup_.wet_behind}](double t) {
                const SurfaceFlux back = back_flux(air, front, face, t);
                return BoundaryFlux{back.flux, back.slope};
            };
        } else if (room && !room->schedule.empty()) {
            ends.back[k] = [film = room->film,
                            air = scheduled(room->schedule, room->air_temperature,
                                            setup_.utc_offset, when[k])](double t) {
                return BoundaryFlux{film * (air - t), -film};
            };
        }
    }
    return ends;
}

PointFacet::Taken PointFacet::half_step(Instant from, double at, double step, bool gentle,
                                        State& state, Eigen::MatrixXd* map) const {
    const std::array<Instant, 2> when{later(from, at + sdirk_gamma * step), later(from, at + step)};
    const State begin = state;
    const bool stores = capacity_.any();
    double rain = 0.0, snow = 0.0;  // [kg m⁻²] that fall
    if (stores || setup_.surface.snow_albedo) {
        const PointForcing half_way = setup_.forcing(later(from, at + 0.5 * step));
        const double all = std::max(0.0, half_way.rain_mm_h) * step / 3600.0;
        snow = snow_share(half_way.air.temperature) * all;
        rain = all - snow;
    }
    Eigen::MatrixXd given;
    if (map && stores) given = *map;
    StoreRates rates = begin.rates;
    for (int attempt = 0;; ++attempt) {
        // Share, albedo and cover are those of the step's middle.
        Lying lying;
        lying.middle = begin.standing;
        if (stores) lying = lying_over(begin.standing, capacity_, rates, rain, snow, step);
        const double white =
            setup_.surface.snow_albedo
                ? begin.snow_albedo
                : aged_albedo({}, begin.snow_albedo, rates.melting > 0.0, 0.5 * snow, 0.5 * step);
        std::array<SurfaceConditions, 2> c{conditions(when[0], lying.middle, white),
                                           conditions(when[1], lying.middle, white)};
        for (SurfaceConditions& one : c) {
            one.frost_heat =
                (begin.standing.frost + capacity_.caught * snow) * heat_of_fusion / step;
            one.water_heat = (begin.standing.water + rain) * heat_of_fusion / step;
            one.wet_share = lying.wet_share;
        }
        const Ends met = ends(c, when);
        Taken taken;
        taken.step = column.advance(
            {.duration = step,
             .gentle = gentle,
             .top = {&met.top[0], &met.top[1]},
             .back = {met.back[0] ? &met.back[0] : nullptr, met.back[1] ? &met.back[1] : nullptr}},
            state.u, map, &state.rest);
        taken.duration = step;
        taken.last = c[1];
        if (!taken.step.solved) return taken;
        if (!stores) {
            age_snow(taken, snow, state);
            return taken;
        }
        const StoreFlows flows = flows_of(c, taken, lying, gentle);
        const StoreRates found = flows.rates(step);
        const Lying better = lying_over(begin.standing, capacity_, found, rain, snow, step);
        constexpr int most_attempts = 6;
        if (!alike(better, lying, capacity_) && attempt < most_attempts) {
            rates = attempt < 3 ? found : middle_of(rates, found);
            state = begin;
            if (map) *map = given;
            continue;
        }
        state.standing = stored_after(begin.standing, flows, capacity_, state.water);
        state.rates = found;
        taken.melted = flows.melt;
        age_snow(taken, snow, state);
        return taken;
    }
}

StoreFlows PointFacet::flows_of(const std::array<SurfaceConditions, 2>& c, const Taken& taken,
                                const Lying& lying, bool gentle) const {
    StoreFlows flows{.rain = lying.rain, .snow = lying.snow};
    for (std::size_t k = gentle ? 1 : 0; k < 2; ++k) {
        const SurfaceTerms terms = surface_terms(c[k], taken.step.surface[k]);
        add_stage({.weight = taken.duration * (gentle ? 1.0 : stage_weight[k]),
                   .air_temperature = c[k].air.air_temperature,
                   .surface = terms.leaf,
                   .wet_share = lying.wet_share,
                   .wet_latent = terms.wet_evaporation,
                   .frost_melt = terms.frost_melt},
                  flows);
    }
    return flows;
}

/// Of the material itself, or of what lies on it; where none lies it is new.
void PointFacet::age_snow(const Taken& taken, double snow, State& state) const {
    const bool own = setup_.surface.snow_albedo.has_value();
    if (!own && !capacity_.any()) return;
    const AgeingAlbedo law = setup_.surface.snow_albedo.value_or(AgeingAlbedo{});
    if (!own && state.standing.frost <= 0.0) {
        state.snow_albedo = law.fresh;
        return;
    }
    const bool melting = own ? taken.step.surface[1] >= zero_celsius : taken.melted > 0.0;
    state.snow_albedo = aged_albedo(law, state.snow_albedo, melting, snow, taken.duration);
}

}  // namespace diurna
