#include "thermal/point_facet.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

constexpr double shortest_step = 1e-3;        // [s]
constexpr double heat_of_fusion = 3.337e5;    // [J kg⁻¹]
constexpr double frost_melting_film = 100.0;  // [W m⁻² K⁻¹] from a warm surface into its frost

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
      setup_(std::move(setup)) {}

SurfaceConditions PointFacet::conditions(Instant when, const Standing& water) const {
    const PointForcing forcing = setup_.forcing(when);
    const ThermalSurface& surface = setup_.surface;
    // Measured light up over light down is the surface's albedo, wet or not.
    double albedo = forcing.albedo;
    if (std::isnan(albedo)) {
        albedo = surface.albedo;
        const WaterStore& store = surface.store;
        if (store.capacity_mm > 0.0 && store.wet_albedo >= 0.0) {
            const double wet = std::min(1.0, water.water / store.capacity_mm);
            albedo += wet * (store.wet_albedo - albedo);
        }
    }
    const double sunlight = forcing.sunlight + albedo * forcing.own_light;
    SurfaceConditions c;
    c.air = air_film(surface, setup_.louis, forcing.air, forcing.wind_speed);
    c.natural = natural_film(setup_.up_cosine);
    c.wind_speed = forcing.wind_speed;
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
    SurfaceConditions c = conditions(when, standing);
    c.wet_share = wet_share(standing, 0.0, 0.0);
    return surface_terms(c, column.temperature(0, u[0]));
}

double PointFacet::wet_share(const Standing& water, double rain, double step) const {
    const WaterStore& store = setup_.surface.store;
    if (store.capacity_mm <= 0.0) return 0.0;
    const double held = water.water + water.frost + 0.5 * rain;
    const double drying = std::max(0.0, -wet_evaporation_) / 2.5e6;  // [kg m⁻² s⁻¹]
    return std::min(1.0, held / (store.capacity_mm + 0.5 * drying * step));
}

PointFacet::Taken PointFacet::half_step(Instant from, double step, bool gentle,
                                        std::vector<double>& state, Standing& water,
                                        Eigen::MatrixXd* map) {
    const std::array<Instant, 2> when{later(from, sdirk_gamma * step), later(from, step)};
    const WaterStore& store = setup_.surface.store;
    const bool stores = store.capacity_mm > 0.0;
    const Standing start = water;
    const std::vector<double> begin = state;
    // Share and albedo are those of the step's middle.
    double share = 0.0;
    Standing middle = start;
    if (stores) {
        const double rain =
            std::max(0.0, setup_.forcing(later(from, 0.5 * step)).rain_mm_h) * step / 3600.0;
        share = wet_share(start, rain, step);
        const double dried = share * std::max(0.0, -wet_evaporation_) / 2.5e6 * step;
        middle.water = std::clamp(start.water + 0.5 * (rain - dried), 0.0, store.capacity_mm);
    }
    std::array<SurfaceConditions, 2> c{conditions(when[0], middle), conditions(when[1], middle)};
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
        if (setup_.surface.back) {
            for (std::size_t k = 0; k < 2; ++k) {
                back[k] = [&air = c[k].air, front = c[k].natural,
                           emissivity = setup_.surface.back->emissivity](double t) {
                    const NaturalFilm film{front.cold, front.warm};  // seen from behind, up is down
                    const Film f = air.plate ? plate_film(air, film, t) : ground_film(air, t);
                    const double radiation = emissivity * stefan_boltzmann;
                    return BoundaryFlux{f.h * (air.air_temperature - t) +
                                            radiation * (power4(air.air_temperature) - power4(t)),
                                        -f.h - f.rise - 4.0 * radiation * t * t * t};
                };
            }
        }
        const auto* room = std::get_if<Interior>(&setup_.surface.bottom);
        const bool timed = room && !setup_.surface.back && !room->schedule.empty();
        for (std::size_t k = 0; timed && k < 2; ++k) {
            back[k] = [film = room->film,
                       air = scheduled(room->schedule, room->air_temperature, setup_.longitude_deg,
                                       when[k])](double t) {
                return BoundaryFlux{film * (air - t), -film};
            };
        }
        const bool behind = setup_.surface.back || timed;
        Taken taken;
        taken.step =
            column.advance(step, gentle, {&top[0], &top[1]},
                           {behind ? &back[0] : nullptr, behind ? &back[1] : nullptr}, state, map);
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
            const double heat = heat_of_vapour(c[k].air.air_temperature, terms.leaf);
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
        const double rain = std::lerp(c[0].rain_mm_h, c[1].rain_mm_h, sdirk_gamma) * step / 3600.0;
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
    const std::span<const Instant> knots = setup_.knot;
    double done = 0.0, melted = 0.0;
    const double span = seconds_between(from, to);
    std::vector<double> whole, halves, middle;
    bool stuck = false;  // the shortest step was not good enough
    while (done < span - 1e-6) {
        const Instant now = later(from, done);
        double step = std::min(next_step_, setup_.longest_step);
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
        const double growth = error > 0.0 ? 0.9 * std::cbrt(setup_.tolerance / error) : 4.0;
        if (error > setup_.tolerance && !last_resort) {
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
        next_step_ = std::clamp(next_step_, shortest_step, setup_.longest_step);
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

void PointFacet::march(Instant from, Instant to, bool restart, Eigen::MatrixXd* map) {
    constexpr double first = 10.0, growth = 3.0;  // [s]
    if (restart) next_march_ = first;
    const double span = seconds_between(from, to);
    for (double done = 0.0; done < span - 1e-6;) {
        double step = std::min(next_march_, setup_.longest_step);
        if (span - done < 1.5 * step) step = span - done;
        march_step(later(from, done), step, 0, map);
        done += step;
        next_march_ = std::min(growth * step, setup_.longest_step);
    }
}

void PointFacet::march_step(Instant from, double step, int depth, Eigen::MatrixXd* map) {
    constexpr int deepest = 10;
    const std::vector<double> start = u;
    const Standing before = standing;
    const double evaporation = wet_evaporation_;
    Eigen::MatrixXd given;
    if (map) given = *map;
    const bool gentle = depth == deepest;
    const Taken taken = half_step(from, step, gentle, u, standing, map);
    ++count.steps;
    if (gentle) ++count.limited;
    if (taken.step.solved) {
        count_closure(taken, start, u);
        column.drain(u);
        return;
    }
    u = start;
    standing = before;
    wet_evaporation_ = evaporation;
    if (map) *map = given;
    if (gentle) return;
    march_step(from, 0.5 * step, depth + 1, map);
    march_step(later(from, 0.5 * step), 0.5 * step, depth + 1, map);
}

double PointFacet::close_period(const std::vector<double>& start, const Eigen::MatrixXd& map) {
    const auto n = static_cast<Eigen::Index>(u.size());
    Eigen::VectorXd change(n);
    for (Eigen::Index i = 0; i < n; ++i) change[i] = u[std::size_t(i)] - start[std::size_t(i)];
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> period;
    period.setThreshold(1e-9);  // a column that loses nothing keeps its mean
    period.compute(Eigen::MatrixXd::Identity(n, n) - map);
    // Where water freezes the map bends, and a whole step of Newton's may lead astray.
    const Eigen::VectorXd move = period.solve(change);
    constexpr double farthest = 20.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double from = start[std::size_t(i)];
        const double most = column.linear() ? 1e4 : farthest;
        const double to = from + std::clamp(move[i], -most, most);
        u[std::size_t(i)] = column.up_to_kink(std::size_t(i), from, to);
    }
    const double far = move.cwiseAbs().maxCoeff();
    keep_in_bounds();
    return far;
}

void PointFacet::go_on_from(const PointFacet& other) {
    u = other.u;
    standing = other.standing;
    next_step_ = other.next_step_;
    wet_evaporation_ = other.wet_evaporation_;
}

void PointFacet::keep_in_bounds() {
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double t = column.temperature(i, u[i]);
        if (t < 1.0 || t > 5000.0) u[i] = column.state_of(i, std::clamp(t, 1.0, 5000.0));
    }
    column.drain(u);
}

}  // namespace diurna
