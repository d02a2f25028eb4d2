#include "thermal/solve/point_facets.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// A surface whose water freezes halts at every node the front crosses.
GridOptions grid_of(const ThermalSurface& surface, GridOptions grid) {
    const bool wet = std::any_of(surface.layers.begin(), surface.layers.end(), [](const Layer& l) {
        return std::holds_alternative<Freezing>(l.law) || std::holds_alternative<Melting>(l.law);
    });
    if (wet) {
        grid.first = std::min(grid.first, 0.01);
        grid.growth = std::min(grid.growth, 0.15);
    }
    return grid;
}

/// What one facet meets, straight between the instants.
struct Meets {
    const std::vector<Forcing>& weather;  // (instant)
    const std::vector<SkyState>& sky;     // (instant)
    Instant start;
    double step;                             // [s]
    std::vector<double> sunlight, longwave;  // (instant) [W m⁻²]
    std::vector<HeatJump> jump;              // of step i from first_jump[i] to first_jump[i + 1]
    std::vector<std::size_t> first_jump;

    PointForcing operator()(Instant when) const {
        const double place = seconds_between(start, when) / step;
        const auto last = sunlight.size() - 2;
        const auto i = std::min(static_cast<std::size_t>(std::max(0.0, place)), last);
        const double x = std::clamp(place - double(i), 0.0, 1.0);
        const Forcing &a = weather[i], &b = weather[i + 1];
        PointForcing f{
            .air = {.temperature = std::lerp(a.air.temperature, b.air.temperature, x),
                    .pressure = std::lerp(a.air.pressure, b.air.pressure, x),
                    .vapour_pressure = std::lerp(a.air.vapour_pressure, b.air.vapour_pressure, x)},
            .wind_speed = std::lerp(a.wind_speed, b.wind_speed, x),
            .rain_mm_h = std::lerp(a.rain_mm_h, b.rain_mm_h, x),
            .sunlight = std::lerp(sunlight[i], sunlight[i + 1], x),
            .own_light = 0.0,
            .albedo = std::lerp(sky[i].albedo, sky[i + 1].albedo, x),
            .longwave_in = std::lerp(longwave[i], longwave[i + 1], x),
            .own_view = 0.0};
        // The straight line has the jump in it; a millisecond behind the edge it is done.
        const std::size_t from = jump.empty() ? 0 : first_jump[i];
        const std::size_t to = jump.empty() ? 0 : first_jump[i + 1];
        for (std::size_t k = from; k < to; ++k) {
            const double done = std::clamp((x - jump[k].share) * step / 1e-3, 0.0, 1.0);
            f.sunlight += (done - x) * jump[k].heat;
        }
        f.sunlight = std::max(0.0, f.sunlight);
        return f;
    }
};

double drift(const Standing& a, const Standing& b) {
    return std::abs(a.water - b.water) + std::abs(a.frost - b.frost);
}

}  // namespace

PointNeed point_need(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    if (!std::holds_alternative<std::monostate>(surface.canopy) ||
        surface.store.capacity_mm > 0.0 || surface.snow_albedo ||
        !surface.internal_schedule.empty() || (room && !room->schedule.empty())) {
        return PointNeed::always;
    }
    PointNeed need = PointNeed::never;
    for (const Layer& layer : surface.layers) {
        if (std::holds_alternative<Melting>(layer.law) ||
            std::holds_alternative<Radiating>(layer.law)) {
            return PointNeed::always;
        }
        const auto* freezing = std::get_if<Freezing>(&layer.law);
        if (freezing && freezing->water > 0.0) need = PointNeed::if_freezing;
    }
    return need;
}

void PointFacets::take_in(const Level& level) {
    if (taken_.empty()) taken_.assign(solve_.facets, false);
    fresh_ = false;
    for (std::size_t b = 0; b < solve_.block.size(); ++b) {
        const Block& block = solve_.block[b];
        const ThermalSurface& surface = level.kind[block.material].column.surface;
        const PointNeed need = point_need(surface);
        if (need == PointNeed::never) continue;
        const auto* below = std::get_if<FixedTemperature>(&surface.bottom);
        const bool frozen = below && below->temperature < zero_celsius;
        for (std::size_t l = 0; l < block.facet.size(); ++l) {
            const std::size_t f = block.facet[l];
            if (taken_[f]) continue;
            bool cold = need == PointNeed::always || frozen;
            for (std::size_t i = 0; !cold && i < solve_.instant.size(); ++i) {
                cold = solve_.kelvin[i * solve_.facets + f] < zero_celsius;
            }
            if (!cold) continue;
            taken_[f] = fresh_ = true;
            point_.push_back({.facet = f,
                              .block = b,
                              .lane = l,
                              .u = {},
                              .standing = {},
                              .kelvin = {},
                              .excess = {},
                              .count = {}});
        }
    }
    if (fresh_ && weather_.empty()) {
        for (const Instant when : solve_.instant) weather_.push_back(solve_.input.weather.at(when));
    }
}

bool PointFacets::rests(const Point& p) const {
    if (!p.begun) return false;
    if (solve_.options.periodic && (p.residual > solve_.options.tolerance || p.move > 0.01)) {
        return false;
    }
    if (solve_.excess.empty()) return true;
    constexpr double counts = 0.05;  // [W m⁻²], as for blocks
    for (std::size_t i = 0; i < p.excess.size(); ++i) {
        if (std::abs(solve_.excess[i * solve_.facets + p.facet] - p.excess[i]) > counts)
            return false;
    }
    return true;
}

void PointFacets::run(const Level& level, Point& p) const {
    constexpr int most_passes = 8;          // at a time: neighbours change in between
    constexpr double settled_water = 1e-3;  // [mm]
    const Block& block = solve_.block[p.block];
    const MaterialColumn& column = level.kind[block.material].column;
    const ThermalSurface& surface = column.surface;
    const std::size_t instants = solve_.instant.size();
    const double up = solve_.input.facets.normal[p.facet].z();

    Meets meets{.weather = weather_,
                .sky = solve_.sky,
                .start = solve_.instant.front(),
                .step = solve_.step,
                .sunlight = {},
                .longwave = {},
                .jump = {},
                .first_jump = {}};
    if (!solve_.excess.empty()) p.excess.resize(instants);
    double mean = 0.0;
    for (std::size_t i = 0; i < instants; ++i) {
        const std::size_t at = i * solve_.facets + p.facet;
        double longwave = solve_.sky[i].longwave_down;
        if (!solve_.excess.empty()) longwave += p.excess[i] = solve_.excess[at];
        if (!solve_.tilt.empty()) longwave += solve_.tilt[p.facet] * solve_.sky[i].tilted_longwave;
        meets.sunlight.push_back(solve_.sunlight[at]);
        meets.longwave.push_back(longwave);
        mean += solve_.kelvin[at] / double(instants);
    }
    std::vector<Instant> edge;  // (jump)
    for (std::size_t i = 0; !block.jump.empty() && i < solve_.steps(); ++i) {
        meets.first_jump.push_back(meets.jump.size());
        for (std::size_t k = block.jumps[i]; k < block.jumps[i + 1]; ++k) {
            if (block.jump[k].lane != p.lane) continue;
            meets.jump.push_back(block.jump[k]);
            edge.push_back(later(solve_.instant[i], block.jump[k].share * solve_.step));
        }
    }
    if (!block.jump.empty()) meets.first_jump.push_back(meets.jump.size());

    PointFacet facet({.surface = surface,
                      .louis = column.louis,
                      .up_cosine = up,
                      .wind_height = solve_.input.weather.wind_height,
                      .longitude_deg = solve_.input.site.longitude_deg,
                      .reference = column.reference,
                      .grid = grid_of(surface, solve_.options.grid),
                      .longest_step = solve_.step / solve_.options.refinement,
                      .forcing = [&](Instant when) { return meets(when); }});
    const std::size_t n = facet.column.size();
    if (p.begun) {
        facet.u = p.u;
        facet.standing = p.standing;
    } else {
        // The plain facet's mean above, what lies below underneath, straight between.
        double below = mean, deep = 0.0;
        if (const auto* fixed = std::get_if<FixedTemperature>(&surface.bottom)) {
            below = fixed->temperature;
        } else if (const auto* room = std::get_if<Interior>(&surface.bottom)) {
            below = room->air_temperature;
        }
        for (const Layer& layer : surface.layers) deep += layer.thickness;
        for (std::size_t i = 0; i < n; ++i) {
            const double share = facet.column.depth(i) / deep;
            facet.u[i] = facet.column.state_of(i, std::lerp(mean, below, share));
        }
        p.begun = true;
    }
    p.kelvin.resize(instants);
    const auto size = static_cast<Eigen::Index>(n);
    for (int pass = 0; pass < most_passes; ++pass) {
        const std::vector<double> start = facet.u;
        const Standing stood = facet.standing;
        Eigen::MatrixXd map;
        Eigen::MatrixXd* carried = nullptr;
        if (solve_.options.periodic) {
            map = Eigen::MatrixXd::Identity(size, size);
            carried = &map;
        }
        facet.count = {};
        p.kelvin[0] = float(facet.terms(solve_.instant[0]).radiometric);
        std::size_t k = 0;
        bool restart = true;
        for (std::size_t i = 0; i + 1 < instants; ++i) {
            Instant now = solve_.instant[i];
            for (; k < edge.size() && edge[k] < solve_.instant[i + 1]; ++k) {
                facet.march(now, edge[k], restart, carried);
                now = edge[k];
                restart = true;
            }
            facet.march(now, solve_.instant[i + 1], restart, carried);
            restart = false;
            p.kelvin[i + 1] = float(facet.terms(solve_.instant[i + 1]).radiometric);
        }
        ++p.passes;
        p.count = facet.count;
        if (!solve_.options.periodic) {
            facet.u = start;  // a span that does not repeat begins where it began
            facet.standing = stood;
            break;
        }
        p.residual = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            p.residual = std::max(p.residual, std::abs(facet.u[i] - start[i]));
        }
        p.move = facet.close_period(start, map);
        if (p.residual <= solve_.options.tolerance && p.move <= 0.01 &&
            drift(facet.standing, stood) <= settled_water) {
            break;
        }
    }
    p.u = facet.u;
    p.standing = facet.standing;
}

void PointFacets::pass(SolveState& solve, const Level& level) {
    take_in(level);
    for_each_index(
        point_.size(),
        [&](std::size_t i) {
            if (!rests(point_[i])) run(level, point_[i]);
        },
        1);
    put(solve);
}

void PointFacets::put(SolveState& solve) const {
    for (const Point& p : point_) {
        for (std::size_t i = 0; i < p.kelvin.size(); ++i) {
            solve.kelvin[i * solve.facets + p.facet] = p.kelvin[i];
        }
    }
}

PointFacets::Summary PointFacets::summary() const {
    Summary s{.fresh = fresh_};
    for (const Point& p : point_) {
        s.residual = std::max(s.residual, p.residual);
        s.largest_move = std::max(s.largest_move, p.move);
        s.worst_closure = std::max(s.worst_closure, p.count.worst_closure);
        s.worst_passes = std::max(s.worst_passes, p.passes);
        s.limited += p.count.limited;
    }
    return s;
}

}  // namespace diurna
