#include "thermal/point/run_column.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/point/point_facet.hpp"
#include "thermal/point/point_weather.hpp"
#include "thermal/point/spin_up.hpp"
#include "thermal/weather/repeated_day.hpp"
#include "thermal/weather/wind_share.hpp"

namespace diurna {

namespace {

/// The given profile at a depth.
double profile_at(const std::vector<SoilPoint>& profile, double depth) {
    const auto below =
        std::upper_bound(profile.begin(), profile.end(), depth,
                         [](double value, const SoilPoint& point) { return value < point.depth; });
    if (below == profile.begin()) return profile.front().temperature;
    if (below == profile.end()) return profile.back().temperature;
    const SoilPoint &a = *(below - 1), &b = *below;
    return std::lerp(a.temperature, b.temperature, (depth - a.depth) / (b.depth - a.depth));
}

double initial_temperature(const PointJob& job) {
    if (!std::isnan(job.initial_temperature)) return job.initial_temperature;
    if (const auto* fixed = std::get_if<FixedTemperature>(&job.surface.bottom)) {
        return fixed->temperature;
    }
    return job.weather.at(job.start).air.temperature;
}

/// The temperatures that a job says its ground starts with, or a guess.
void place_start(const PointJob& job, PointFacet& facet) {
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        const double start = job.initial_profile.empty()
                                 ? initial_temperature(job)
                                 : profile_at(job.initial_profile, facet.column.depth(i));
        facet.u[i] = facet.column.state_of(i, start);
    }
}

/// What the facet is to the wind: of a size that its material knows, as high as it is said to be.
FilmPart part_in_wind(const PointJob& job) {
    FilmPart part;
    if (job.height > 0.0) part.wind = float(wind_at_height(job.height, job.weather.wind_height));
    return part;
}

/// The job as it was before its start, for the spin-up.
PointJob before_start(const PointJob& job) {
    PointJob before = job;
    if (job.spin_up == SpinUp::first_day &&
        seconds_between(job.start, job.end) >= 0.99 * seconds_of_day) {
        before.weather = without_trend(job.weather, job.start);
    }
    return before;
}

/// Straight between nodes, which lie on the layers' boundaries; below the last as there.
double temperature_at(const PointFacet& facet, double depth) {
    const NonlinearColumn& column = facet.column;
    const auto node = [&](std::size_t i) { return column.temperature(i, facet.u[i]); };
    std::size_t below = 0;
    while (below < column.size() && column.depth(below) < depth) ++below;
    if (below == 0) return node(0);
    if (below == column.size()) return node(below - 1);
    const double above = column.depth(below - 1);
    return std::lerp(node(below - 1), node(below), (depth - above) / (column.depth(below) - above));
}

PointRow row_of(const PointFacet& facet, Instant when, double melt, double depth) {
    const SurfaceTerms terms = facet.terms(when);
    const HeatBalance& b = terms.balance;
    return {.instant = when,
            .surface_temperature = terms.radiometric,
            .absorbed_solar = b.absorbed_solar,
            .longwave_in = b.longwave_in,
            .longwave_out = b.longwave_out,
            .sensible = b.sensible,
            .latent = b.latent,
            // The ground takes what the other terms leave over.
            .conducted = -b.sum() - terms.frost_melt,
            .back_temperature = facet.column.temperature(facet.column.size() - 1, facet.u.back()),
            .ground_temperature = facet.column.temperature(0, facet.u[0]),
            .leaf_temperature = terms.leaf,
            .water_mm = facet.standing.water,
            .frost_mm = facet.standing.frost,
            .melt = melt,
            .depth_temperature = temperature_at(facet, depth)};
}

/// What columns the result has.
PointResult empty_result(const PointJob& job) {
    PointResult result;
    result.has_back = job.surface.back.has_value();
    result.has_canopy = !std::holds_alternative<std::monostate>(job.surface.canopy);
    result.has_store = job.surface.store.capacity_mm > 0.0;
    result.has_melt =
        result.has_store ||
        std::any_of(job.surface.layers.begin(), job.surface.layers.end(),
                    [](const Layer& layer) { return std::holds_alternative<Melting>(layer.law); });
    return result;
}

/// The span itself, row by row, and what it leaves.
void follow(const PointJob& job, PointFacet& facet, PointResult& result) {
    const auto rows =
        static_cast<long long>(std::floor(seconds_between(job.start, job.end) / job.step + 1e-9));
    result.row.push_back(row_of(facet, job.start, 0.0, job.depth));
    facet.water = {};
    for (long long i = 0; i < rows; ++i) {
        const Instant from = later(job.start, double(i) * job.step);
        const Instant to = later(job.start, double(i + 1) * job.step);
        const double melted = facet.advance(from, to);
        result.row.push_back(row_of(facet, to, melted / job.step, job.depth));
    }
    result.water = facet.water;
    result.worst_energy_closure = facet.count.worst_closure;
    result.steps = facet.count.steps;
    result.rejected = facet.count.rejected;
    result.limited = facet.count.limited;
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        result.depth.push_back(facet.column.depth(i));
        result.final_profile.push_back(facet.column.temperature(i, facet.u[i]));
    }
}

}  // namespace

PointResult run_column(const PointJob& job) {
    const PointJob before = before_start(job);
    PointWeather weather(job), weather_before(before);
    const LouisForm louis =
        louis_form(job.surface.roughness_length, job.surface.heat_roughness_length,
                   job.weather.wind_height, job.weather.air_height);
    const auto facet_of = [&](const ThermalSurface& surface, PointWeather& from) {
        return PointFacet({.surface = surface,
                           .louis = louis,
                           .up_cosine = from.up_cosine(),
                           .part = part_in_wind(job),
                           .wind_height = job.weather.wind_height,
                           .utc_offset = job.utc_offset,
                           .reference = job.weather.at(job.start).air.temperature,
                           .grid = point_grid(job.surface),
                           .longest_step = job.longest_step,
                           .tolerance = job.tolerance,
                           .knot = job.weather.instant,
                           .forcing = [&from](Instant when) { return from(when); }});
    };
    PointFacet facet = facet_of(job.surface, weather);
    place_start(job, facet);
    PointResult result = empty_result(job);
    result.note = weather.note();
    if (job.spin_up != SpinUp::none) {
        const Instant day_later = later(job.start, seconds_of_day);
        const Instant end =
            job.spin_up == SpinUp::periodic ? job.end : std::min(job.end, day_later);
        const SpunUp spun = spin_up(
            facet, job.surface, job.start, end, job.tolerance,
            [&](const ThermalSurface& surface) { return facet_of(surface, weather_before); });
        result.passes = spun.passes;
        result.periodic_residual = spun.residual;
        result.periodic_error = spun.error;
        result.store_held = spun.store_held;
        result.standing_residual = spun.standing_residual;
        result.converged = spun.converged;
    }
    follow(job, facet, result);
    return result;
}

}  // namespace diurna
