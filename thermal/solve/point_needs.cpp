// Which facets need more than their blocks, and why.

#include <algorithm>
#include <variant>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "thermal/solve/dew_need.hpp"
#include "thermal/solve/point_facets.hpp"

namespace diurna {

namespace {

bool has_water(const Layer& layer) {
    const auto* freezing = std::get_if<Freezing>(&layer.law);
    return freezing && freezing->water > 0.0;
}

}  // namespace

bool freezes(const ThermalSurface& surface) {
    return std::any_of(surface.layers.begin(), surface.layers.end(), has_water);
}

GridOptions grid_of_point(const ThermalSurface& surface, GridOptions grid) {
    const bool wet = std::any_of(surface.layers.begin(), surface.layers.end(), [](const Layer& l) {
        return std::holds_alternative<Freezing>(l.law) || std::holds_alternative<Melting>(l.law);
    });
    if (wet) {
        grid.first = std::min(grid.first, 0.01);
        grid.growth = std::min(grid.growth, 0.15);
    }
    return grid;
}

PointNeed point_need(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    if (!std::holds_alternative<std::monostate>(surface.canopy) || surface.snow_albedo ||
        !surface.internal_schedule.empty() || (room && !room->schedule.empty())) {
        return PointNeed::always;
    }
    PointNeed need = surface.store.capacity_mm > 0.0 ? PointNeed::if_wet : PointNeed::never;
    for (const Layer& layer : surface.layers) {
        if (std::holds_alternative<Melting>(layer.law) ||
            std::holds_alternative<Radiating>(layer.law)) {
            return PointNeed::always;
        }
        if (need == PointNeed::never && has_water(layer)) need = PointNeed::if_freezing;
    }
    return need;
}

/// Whether a block's facet needs more, as warm as it is now.
///
/// all_dew  or only where dew decides: ground that evaporates stays in its block
/// warmest  that gathers dew in the block; found where it is still empty
PointFacets::Need PointFacets::need_of(const Level& level, const Block& block, std::size_t l,
                                       bool all_dew, std::vector<double>& warmest) const {
    const Kind& kind = level.kind[block.material];
    const ThermalSurface& surface = kind.column.surface;
    const std::size_t f = block.facet[l];
    const PointNeed need = point_need(surface);
    if (need == PointNeed::always) return {.taken = true};
    if (need == PointNeed::never) return {};
    const auto* below = std::get_if<FixedTemperature>(&surface.bottom);
    if (freezes(surface)) {
        bool cold = below && below->temperature < zero_celsius;
        for (std::size_t i = 0; !cold && i < solve_.instant.size(); ++i) {
            cold = double(solve_.kelvin.at(i, f)) < zero_celsius;
        }
        if (cold) return {.taken = true};
    }
    if (need != PointNeed::if_wet) return {};
    if (rains_ && rain_on(solve_, f) > 0.0) return {.taken = true};
    const bool dry = surface.evaporation.wetness == 0.0;
    if (!dry && !all_dew) return {};
    if (warmest.empty()) warmest = warmest_dew(solve_, kind, block);
    const Dew dew = dew_on(solve_, kind, block, l, warmest);
    const double least = solve_.options.least_dew;
    return {.taken = dry && dew.most_warming > 0.0 && dew.most_warming >= least,
            .unfollowed = true,
            .dew = dew.gathered,
            .warming = dry ? dew.most_warming : 0.0};
}

/// (block, lane) Nothing for points and targets.
std::vector<std::vector<PointFacets::Need>> PointFacets::all_needs(const Level& level,
                                                                   bool all_dew) const {
    std::vector<std::vector<Need>> need(solve_.block.size());
    for_each_index(
        need.size(),
        [&](std::size_t b) {
            const Block& block = solve_.block[b];
            std::vector<double> warmest;
            for (std::size_t l = 0; l < block.facet.size(); ++l) {
                const std::size_t f = block.facet[l];
                const bool target = !solve_.in_network.empty() && solve_.in_network[f];
                const bool known = taken_[f] || target;
                need[b].push_back(known ? Need{} : need_of(level, block, l, all_dew, warmest));
            }
        },
        4);
    return need;
}

void PointFacets::measure_left_out(const Level& level) {
    left_out_ = {};
    const std::vector<std::vector<Need>> need = all_needs(level, true);
    for (std::size_t b = 0; b < need.size(); ++b) {
        for (std::size_t l = 0; l < need[b].size(); ++l) {
            if (solve_.block[b].facet[l] >= solve_.counted) continue;
            const Need& one = need[b][l];
            left_out_.unfollowed += one.unfollowed ? 1 : 0;
            left_out_.most_dew_unfollowed = std::max(left_out_.most_dew_unfollowed, one.dew);
            left_out_.dew_left_out = std::max(left_out_.dew_left_out, one.warming);
        }
    }
}

}  // namespace diurna
