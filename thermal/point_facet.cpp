#include "thermal/point_facet.hpp"

#include <algorithm>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

constexpr double shortest_step = 1e-3;        // [s]
constexpr double heat_of_fusion = 3.337e5;    // [J kg⁻¹]
constexpr double frost_melting_film = 100.0;  // [W m⁻² K⁻¹] from a warm surface into its frost

/// Fine enough for a minute's shock on a dry half-space, and never cut off: the span may be a year.
/// A front of melting halts at every node it crosses, so water is cut less finely.
GridOptions grid_of(const ThermalSurface& surface) {
    const bool wet = std::any_of(surface.layers.begin(), surface.layers.end(), [](const Layer& l) {
        return std::holds_alternative<Freezing>(l.law) || std::holds_alternative<Melting>(l.law);
    });
    return {.first = wet ? 0.005 : 0.001, .growth = wet ? 0.1 : 0.055, .deepest = 1e9};
}

Bottom bottom_of(const ThermalSurface& surface) {
    // Behind a plate stands air; the grid then ends free.
    return surface.back ? Bottom{FixedFlux{0.0}} : surface.bottom;
}

/// A room's air at an instant, by local mean solar time.
double scheduled(const Interior& room, double longitude_deg, Instant when) {
    if (room.schedule.empty()) return room.air_temperature;
    const double seconds = std::chrono::duration<double>(when.time_since_epoch()).count();
    double hour = std::fmod(seconds / 3600.0 + longitude_deg / 15.0, 24.0);
    if (hour < 0.0) hour += 24.0;
    const auto& s = room.schedule;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool last = i + 1 == s.size();
        const double from = s[i][0], to = last ? s[0][0] + 24.0 : s[i + 1][0];
        const double at = hour < s[0][0] ? hour + 24.0 : hour;
        if (at < from || at > to) continue;
        const double next = last ? s[0][1] : s[i + 1][1];
        return to > from ? std::lerp(s[i][1], next, (at - from) / (to - from)) : next;
    }
    return s[0][1];
}

}  // namespace

PointFacet::PointFacet(const ColumnJob& job)
    : column(job.surface.layers, bottom_of(job.surface), job.weather.at(job.start).air.temperature,
             grid_of(job.surface)),
      u(column.size(), 0.0),
      job_(job),
      sun_(job.site),
      louis_(louis_form(job.surface.roughness_length, job.surface.heat_roughness_length,
                        job.weather.wind_height, job.weather.air_height)),
      normal_(direction(job.aspect_deg, 90.0 - job.slope_deg)),
      // Where terrain hides more than the facet's own tilt, it hides the horizon first.
      sky_excess_(job.clear_sky.longwave_by_direction && job.slope_deg > 0.0 &&
                          job.sky_view > 0.5 * (1.0 + normal_.z()) - 1e-3
                      ? tilted_sky_excess(radians(job.slope_deg))
                      : 0.0) {}

SurfaceConditions PointFacet::conditions(Instant when) {
    Forcing forcing = job_.weather.at(when);
    const ThermalSurface& surface = job_.surface;
    const SkyState sky = sky_state(sun_.at(when), job_.elevation, forcing, job_.clear_sky);
    // Measured light up over light down is the surface's albedo, wet or not.
    double albedo = sky.albedo;
    if (std::isnan(albedo)) {
        albedo = surface.albedo;
        const WaterStore& store = surface.store;
        if (store.capacity_mm > 0.0 && store.wet_albedo >= 0.0) {
            const double wet = std::min(1.0, standing.water / store.capacity_mm);
            albedo += wet * (store.wet_albedo - albedo);
        }
    }
    double sunlight = sky.plane_of_array;
    if (std::isnan(sunlight)) {
        sunlight = facet_sunlight(sky, normal_.dot(sky.to_sun), 1.0, job_.sky_view) +
                   (1.0 - job_.sky_view) * albedo * sky.global_horizontal();
    }
    SurfaceConditions c;
    if (job_.airspeed > 0.0) {
        forcing.air.temperature = recovery_temperature(forcing.air.temperature, job_.airspeed);
        forcing.wind_speed = job_.airspeed;
    }
    c.air = air_film(surface, louis_, forcing.air, forcing.wind_speed);
    c.natural = natural_film(normal_.z());
    c.wind_speed = forcing.wind_speed;
    c.wind_height = job_.weather.wind_height;
    c.absorbed_solar = std::max(0.0, 1.0 - albedo - surface.solar_transmittance) * sunlight;
    c.longwave_in = job_.sky_view * sky.longwave_down;
    if (sky_excess_ != 0.0) {
        c.longwave_in += sky.clear_share * sky_excess_ * stefan_boltzmann *
                         power4(job_.weather.at(when).air.temperature);
    }
    c.own_view = 1.0 - job_.sky_view;
    c.emissivity = surface.emissivity;
    c.internal = surface.internal_heat;
    c.stores = surface.store.capacity_mm > 0.0;
    c.canopy = surface.canopy;
    return c;
}

double PointFacet::wet_share(double step) const {
    const WaterStore& store = job_.surface.store;
    if (store.capacity_mm <= 0.0) return 0.0;
    const double held = standing.water + standing.frost;
    const double drying = std::max(0.0, -wet_evaporation_) / 2.5e6;  // [kg m⁻² s⁻¹]
    return std::min(1.0, held / (store.capacity_mm + drying * step));
}

PointFacet::Taken PointFacet::half_step(Instant from, double step, bool gentle,
                                        std::vector<double>& state, Standing& water,
                                        Eigen::MatrixXd* map) {
    const std::array<Instant, 2> when{later(from, sdirk_gamma * step), later(from, step)};
    std::array<SurfaceConditions, 2> c{conditions(when[0]), conditions(when[1])};
    if (const auto* room = std::get_if<Interior>(&job_.surface.bottom)) {
        if (!room->schedule.empty()) {
            column.set_below(scheduled(*room, job_.site.longitude_deg, when[1]));
        }
    }
    const WaterStore& store = job_.surface.store;
    const bool stores = store.capacity_mm > 0.0;
    const Standing start = water;
    const std::vector<double> begin = state;
    double share = stores ? wet_share(step) : 0.0;
    Eigen::MatrixXd given;
    if (map && stores) given = *map;
    for (int attempt = 0;; ++attempt) {
        for (SurfaceConditions& at : c) {
            at.wet_share = share;
            at.frost_conductance = start.frost > 0.0 ? std::min(frost_melting_film,
                                                                start.frost * heat_of_fusion / step)
                                                     : 0.0;
        }
        const std::array<Boundary, 2> top{
            [&](double t) {
                const SurfaceTerms terms = surface_terms(c[0], t);
                return BoundaryFlux{terms.into_ground, terms.into_ground_slope};
            },
            [&](double t) {
                const SurfaceTerms terms = surface_terms(c[1], t);
                return BoundaryFlux{terms.into_ground, terms.into_ground_slope};
            }};
        std::array<Boundary, 2> back;
        if (job_.surface.back) {
            for (std::size_t k = 0; k < 2; ++k) {
                back[k] = [&air = c[k].air, front = c[k].natural,
                           emissivity = job_.surface.back->emissivity](double t) {
                    const NaturalFilm film{front.cold, front.warm};  // seen from behind, up is down
                    const Film f = air.plate ? plate_film(air, film, t) : ground_film(air, t);
                    const double radiation = emissivity * stefan_boltzmann;
                    return BoundaryFlux{f.h * (air.air_temperature - t) +
                                            radiation * (power4(air.air_temperature) - power4(t)),
                                        -f.h - f.rise - 4.0 * radiation * t * t * t};
                };
            }
        }
        const bool plate = job_.surface.back.has_value();
        Taken taken;
        taken.step =
            column.advance(step, gentle, {&top[0], &top[1]},
                           {plate ? &back[0] : nullptr, plate ? &back[1] : nullptr}, state, map);
        taken.terms = step * (1e-3 + c[1].absorbed_solar + std::abs(c[1].internal) +
                              c[1].emissivity * stefan_boltzmann * power4(taken.step.surface[1]));
        if (!taken.step.solved || !stores) return taken;

        // What stands on the surface: rain, dew and evaporation over the step.
        double evaporated = 0.0, free = 0.0, melt = 0.0;  // kg, J/m², J/m²
        double deposited_ice = 0.0, deposited = 0.0;
        for (std::size_t k = gentle ? 1 : 0; k < 2; ++k) {
            const double weight = gentle ? step : step * (k == 0 ? 1.0 - sdirk_gamma : sdirk_gamma);
            const double t = taken.step.surface[k];
            const SurfaceTerms terms = surface_terms(c[k], t);
            const double heat = latent_heat_of_vaporisation(c[k].air.air_temperature) *
                                (terms.leaf < zero_celsius ? 2.834 / 2.501 : 1.0);
            const double gain = weight * terms.wet_evaporation / heat;
            free += weight * terms.wet_evaporation / step;
            melt += -weight * terms.frost_melt;
            if (gain < 0.0) {
                evaporated -= share * gain;
            } else if (terms.leaf < zero_celsius) {
                deposited_ice += gain;
            } else {
                deposited += gain;
            }
        }
        const Forcing weather = job_.weather.at(when[1]);
        const double rain = std::max(0.0, weather.rain_mm_h) * step / 3600.0;
        const bool freezes = taken.step.surface[1] < zero_celsius;
        const double have = start.water + start.frost + rain + deposited + deposited_ice;
        if (evaporated > have && attempt < 4) {
            share *= have / evaporated;
            state = begin;
            if (map) *map = given;
            continue;
        }
        const double melted = std::min(start.frost, melt / heat_of_fusion);
        water.frost = start.frost + deposited_ice - melted + (freezes ? rain : 0.0);
        water.water = start.water + deposited + melted + (freezes ? 0.0 : rain);
        const double total = water.water + water.frost;
        const double left = std::max(0.0, total - evaporated);
        if (total > 0.0) {
            water.water *= left / total;
            water.frost *= left / total;
        }
        // What is more than it holds runs off, or lies as snow that this surface is not.
        const double over = water.water + water.frost - store.capacity_mm;
        if (over > 0.0) {
            const double off = std::min(over, water.water);
            water.water -= off;
            water.frost = std::min(water.frost, store.capacity_mm);
        }
        wet_evaporation_ = free;
        taken.melted += melt;
        return taken;
    }
}

void PointFacet::count_closure(const Taken& taken, const std::vector<double>& before,
                               const std::vector<double>& after) {
    // Node by node: the sum of a deep column's heat has no digits left for a short step.
    double gained = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        gained += column.heat(i, after[i]) - column.heat(i, before[i]);
    }
    const double scale = taken.step.through + taken.terms;
    count.worst_closure =
        std::max(count.worst_closure, std::abs(gained - taken.step.heat_in) / scale);
}

double PointFacet::advance(Instant from, Instant to, std::vector<double>* steps,
                           Eigen::MatrixXd* map) {
    const auto& knots = job_.weather.instant;
    double done = 0.0, melted = 0.0;
    const double span = seconds_between(from, to);
    std::vector<double> whole, halves, middle;
    bool stuck = false;  // the shortest step was not good enough
    while (done < span - 1e-6) {
        const Instant now = later(from, done);
        double step = std::min(next_step_, job_.longest_step);
        // To the next sample of the weather, or half way there.
        const auto knot = std::upper_bound(knots.begin(), knots.end(), now);
        double limit = span - done;
        if (knot != knots.end()) {
            const double ahead = seconds_between(now, *knot);
            if (ahead > 1e-6) limit = std::min(limit, ahead);
        }
        const bool cut = step >= limit - 2e-3;
        if (cut) {
            step = limit;
        } else if (step > 0.5 * limit) {
            step = 0.5 * limit;
        }
        // Instants are whole milliseconds.
        step = std::max(shortest_step, std::round(step * 1e3) / 1e3);
        const bool last_resort = stuck;

        whole = u;
        halves = u;
        Standing whole_water = standing, water = standing;
        const double evaporation = wet_evaporation_;
        const Taken once = half_step(now, step, last_resort, whole, whole_water, nullptr);
        wet_evaporation_ = evaporation;
        Taken first, second;
        double error = 1e9;
        if (once.step.solved) {
            first = half_step(now, 0.5 * step, last_resort, halves, water, nullptr);
            middle = halves;
            if (first.step.solved) {
                second = half_step(later(now, 0.5 * step), 0.5 * step, last_resort, halves, water,
                                   nullptr);
                if (second.step.solved) {
                    error = 0.0;
                    for (std::size_t i = 0; i < u.size(); ++i) {
                        error = std::max(error, std::abs(column.temperature(i, halves[i]) -
                                                         column.temperature(i, whole[i])));
                    }
                    error /= 3.0;
                }
            }
        }
        const double growth = error > 0.0 ? 0.9 * std::cbrt(job_.tolerance / error) : 4.0;
        if (error > job_.tolerance && !last_resort) {
            ++count.rejected;
            stuck = step <= shortest_step;
            next_step_ = step * std::clamp(growth, 0.1, 0.7);
            wet_evaporation_ = evaporation;
            continue;
        }
        if (last_resort) ++count.limited;
        stuck = false;
        if (error < 1e9) {
            count_closure(first, u, middle);
            count_closure(second, middle, halves);
            if (map) {
                // Over again with the map, now that the step is known to stand.
                std::vector<double> again = u;
                Standing unused = standing;
                half_step(now, 0.5 * step, last_resort, again, unused, map);
                half_step(later(now, 0.5 * step), 0.5 * step, last_resort, again, unused, map);
            }
            u = halves;
            standing = water;
            melted += first.melted + second.melted + column.drain(u);
        }
        if (steps) steps->push_back(step);
        ++count.steps;
        done += step;
        const double grown = step * std::clamp(growth, 0.2, 4.0);
        // A step cut short by a sample says little of how long the next may be.
        next_step_ = std::max(grown, cut ? std::min(next_step_, 10.0 * grown) : 0.0);
        next_step_ = std::clamp(next_step_, shortest_step, job_.longest_step);
    }
    return melted;
}

void PointFacet::repeat(Instant from, const std::vector<double>& steps, Eigen::MatrixXd& map) {
    double done = 0.0;
    for (const double step : steps) {
        for (int half = 0; half < 2; ++half) {
            std::vector<double> next = u;
            Standing water = standing;
            const Instant now = later(from, done + 0.5 * step * half);
            const Taken taken = half_step(now, 0.5 * step, false, next, water, &map);
            if (taken.step.solved) {
                u = next;
                standing = water;
            }
        }
        column.drain(u);
        done += step;
    }
}

void PointFacet::keep_in_bounds() {
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double t = column.temperature(i, u[i]);
        if (t < 1.0 || t > 5000.0) u[i] = column.state_of(i, std::clamp(t, 1.0, 5000.0));
    }
    column.drain(u);
}

ColumnRow PointFacet::row(Instant when, double melt) {
    SurfaceConditions c = conditions(when);
    c.wet_share = wet_share(0.0);
    const double ground = column.temperature(0, u[0]);
    const SurfaceTerms terms = surface_terms(c, ground);
    const HeatBalance& b = terms.balance;
    return {.instant = when,
            .surface_temperature = terms.radiometric,
            .absorbed_solar = b.absorbed_solar,
            .longwave_in = b.longwave_in,
            .longwave_out = b.longwave_out,
            .sensible = b.sensible,
            .latent = b.latent,
            // The ground takes what the other terms leave over.
            .conducted = -b.sum(),
            .back_temperature = column.temperature(column.size() - 1, u.back()),
            .ground_temperature = ground,
            .leaf_temperature = terms.leaf,
            .water_mm = standing.water,
            .frost_mm = standing.frost,
            .melt = melt};
}

}  // namespace diurna
