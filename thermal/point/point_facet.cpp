#include "thermal/point/point_facet.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/base/units.hpp"
#include "thermal/surface/standing_water.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

constexpr double vapour_heat = 2.5e6;  // [J kg⁻¹] about, for what a step will dry

Bottom bottom_of(const ThermalSurface& surface) {
    // Behind a plate stands air; the grid then ends free.
    return surface.back ? Bottom{FixedFlux{0.0}} : surface.bottom;
}

/// A value that repeats daily by local mean solar time, straight between its entries.
double scheduled(const Schedule& s, double otherwise, double longitude_deg, Instant when) {
    if (s.empty()) return otherwise;
    const double seconds = std::chrono::duration<double>(when.time_since_epoch()).count();
    double hour = std::fmod(seconds / 3600.0 + longitude_deg / 15.0, 24.0);
    if (hour < 0.0) hour += 24.0;
    if (hour < s.front()[0]) hour += 24.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool last = i + 1 == s.size();
        const double from = s[i][0], to = last ? s.front()[0] + 24.0 : s[i + 1][0];
        if (hour > to) continue;
        const double next = last ? s.front()[1] : s[i + 1][1];
        return to > from ? std::lerp(s[i][1], next, (hour - from) / (to - from)) : next;
    }
    return s.front()[1];
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
      snow_albedo_(setup_.surface.albedo) {}

SurfaceConditions PointFacet::conditions(Instant when, const Standing& water,
                                         double snow_albedo) const {
    const PointForcing forcing = setup_.forcing(when);
    const ThermalSurface& surface = setup_.surface;
    // Measured light up over light down is the surface's albedo, wet or not.
    double albedo = forcing.albedo;
    if (std::isnan(albedo)) {
        albedo = surface.snow_albedo ? snow_albedo : surface.albedo;
        const WaterStore& store = surface.store;
        if (store.capacity_mm > 0.0 && store.wet_albedo >= 0.0) {
            const double wet = std::min(1.0, water.water / store.capacity_mm);
            albedo += wet * (store.wet_albedo - albedo);
        }
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
    c.absorbed_solar = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * sunlight;
    c.longwave_in = forcing.longwave_in;
    c.own_view = forcing.own_view;
    c.emissivity = surface.emissivity;
    c.internal =
        scheduled(surface.internal_schedule, surface.internal_heat, setup_.longitude_deg, when);
    c.rain_mm_h = std::max(0.0, forcing.rain_mm_h);
    c.stores = surface.store.capacity_mm > 0.0;
    c.canopy = surface.canopy;
    return c;
}

SurfaceTerms PointFacet::terms(Instant when) const {
    SurfaceConditions c = conditions(when, standing, snow_albedo_);
    c.wet_share = wet_share({.standing = standing, .evaporation = evaporation_}, 0.0, 0.0);
    return surface_terms(c, column.temperature(0, u[0]));
}

double PointFacet::wet_share(const State& state, double rain, double step) const {
    const WaterStore& store = setup_.surface.store;
    if (store.capacity_mm <= 0.0) return 0.0;
    const double held = state.standing.water + state.standing.frost + 0.5 * rain;
    const double drying = std::max(0.0, -state.evaporation) / vapour_heat;  // [kg m⁻² s⁻¹]
    return std::min(1.0, held / (store.capacity_mm + 0.5 * drying * step));
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
                                            setup_.longitude_deg, when[k])](double t) {
                return BoundaryFlux{film * (air - t), -film};
            };
        }
    }
    return ends;
}

PointFacet::Taken PointFacet::half_step(Instant from, double at, double step, bool gentle,
                                        State& state, Eigen::MatrixXd* map) const {
    const std::array<Instant, 2> when{later(from, at + sdirk_gamma * step), later(from, at + step)};
    const WaterStore& store = setup_.surface.store;
    const bool stores = store.capacity_mm > 0.0;
    const State begin = state;
    // Share and albedo are those of the step's middle.
    double share = 0.0, snow = 0.0, water = 0.0;  // [1], [kg m⁻²] that fall
    Standing middle = begin.standing;
    if (stores) {
        const PointForcing half_way = setup_.forcing(later(from, at + 0.5 * step));
        const double rain = std::max(0.0, half_way.rain_mm_h) * step / 3600.0;
        snow = snow_share(half_way.air.temperature) * rain;
        water = rain - snow;
        share = wet_share(begin, rain, step);
        const double dried = share * std::max(0.0, -begin.evaporation) / vapour_heat * step;
        middle.water = std::clamp(middle.water + 0.5 * (rain - dried), 0.0, store.capacity_mm);
    }
    std::array<SurfaceConditions, 2> c{conditions(when[0], middle, begin.snow_albedo),
                                       conditions(when[1], middle, begin.snow_albedo)};
    for (SurfaceConditions& one : c) {
        one.frost_heat = (begin.standing.frost + snow) * heat_of_fusion / step;
        one.water_heat = (begin.standing.water + water) * heat_of_fusion / step;
    }
    const Ends met = ends(c, when);
    Eigen::MatrixXd given;
    if (map && stores) given = *map;
    for (int attempt = 0;; ++attempt) {
        for (SurfaceConditions& one : c) one.wet_share = share;
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
        if (setup_.surface.snow_albedo) {
            const double fallen =
                snow_share(c[1].air.air_temperature) * c[1].rain_mm_h * step / 3600.0;
            state.snow_albedo = aged_albedo(*setup_.surface.snow_albedo, begin.snow_albedo,
                                            taken.step.surface[1] >= zero_celsius, fallen, step);
        }
        if (!stores) return taken;
        const StoreFlows flows = store_flows(c, taken.step.surface, gentle, step);
        const double have = begin.standing.water + begin.standing.frost + flows.gained();
        if (flows.evaporated > have && attempt < 4) {
            share *= have / flows.evaporated;
            state = begin;
            if (map) *map = given;
            continue;
        }
        state.standing = stored_after(begin.standing, flows, store.capacity_mm);
        state.evaporation = flows.free;
        taken.melted = flows.melt;
        return taken;
    }
}

}  // namespace diurna
