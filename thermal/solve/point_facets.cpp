#include "thermal/solve/point_facets.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <tuple>
#include <utility>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "thermal/kernels/enthalpy_kernel.hpp"
#include "thermal/solve/block_profile.hpp"
#include "thermal/solve/dew_need.hpp"
#include "thermal/solve/facet_forcing.hpp"
#include "thermal/solve/heat_record.hpp"

namespace diurna {

namespace {

/// The state of a facet that has not run yet: its plain mean above, what lies below underneath,
/// straight between.
void guess_state(const ThermalSurface& surface, double mean, PointFacet& facet) {
    double below = mean, bottom_depth = 0.0;
    if (const auto* fixed = std::get_if<FixedTemperature>(&surface.bottom)) {
        below = fixed->temperature;
    } else if (const auto* room = std::get_if<Interior>(&surface.bottom)) {
        below = room->air_temperature;
    }
    for (const Layer& layer : surface.layers) bottom_depth += layer.thickness;
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        const double share = facet.column.depth(i) / bottom_depth;
        facet.u[i] = facet.column.state_of(i, std::lerp(mean, below, share));
    }
}

/// The state of a facet that was plain in the span before.
void take_over(const DepthProfile& plain, PointFacet& facet) {
    for (std::size_t i = 0; i < facet.column.size(); ++i) {
        facet.u[i] = facet.column.state_of(i, plain.at(facet.column.depth(i)));
    }
}

}  // namespace

void PointFacets::take_in(const Level& level) {
    if (taken_.empty()) taken_.assign(solve_.facets, false);
    fresh_ = false;
    if (weather_.empty()) {
        for (const Instant when : solve_.instant) {
            weather_.push_back(solve_.series.weather().at(when));
            rains_ = rains_ || weather_.back().rain_mm_h > 0.0;
        }
    }
    const std::vector<std::vector<Need>> need = all_needs(level, false);
    for (std::size_t b = 0; b < need.size(); ++b) {
        const Block& block = solve_.block[b];
        const ThermalSurface& surface = level.kind[block.material].column.surface;
        for (std::size_t l = 0; l < block.facet.size(); ++l) {
            const Need& one = need[b][l];
            const std::size_t f = block.facet[l];
            if (!one.taken) continue;
            taken_[f] = true;
            fresh_ = fresh_ || f < solve_.counted;
            point_.push_back({.facet = f,
                              .block = b,
                              .lane = l,
                              .start = {.facet = f,
                                        .u = {},
                                        .standing = {},
                                        .snow_albedo = new_snow_albedo(surface)},
                              .end = {}});
        }
    }
    for (const FacetPoint& p : point_) fresh_ = fresh_ || (counts(p) && p.kelvin.empty());
}

void PointFacets::set_out_from(const std::vector<HeatState::Point>& left) {
    taken_.assign(solve_.facets, false);
    std::vector<const HeatState::Point*> of(solve_.facets, nullptr);
    for (const HeatState::Point& point : left) of[point.facet] = &point;
    for (std::size_t b = 0; b < solve_.block.size(); ++b) {
        const Block& block = solve_.block[b];
        for (std::size_t l = 0; l < block.facet.size(); ++l) {
            const std::size_t f = block.facet[l];
            if (!of[f]) continue;
            taken_[f] = true;
            point_.push_back(
                {.facet = f, .block = b, .lane = l, .begun = true, .start = *of[f], .end = *of[f]});
        }
    }
}

CoveredFacets PointFacets::cover() const {
    std::vector<const FacetPoint*> covered;
    for (const FacetPoint& p : point_) {
        if (!p.cover.empty()) covered.push_back(&p);
    }
    std::sort(covered.begin(), covered.end(),
              [](const FacetPoint* a, const FacetPoint* b) { return a->facet < b->facet; });
    CoveredFacets all;
    for (const FacetPoint* p : covered) all.facet.push_back(std::uint32_t(p->facet));
    for (std::size_t i = 0; !covered.empty() && i < solve_.instant.size(); ++i) {
        for (const FacetPoint* p : covered) all.cover.push_back(p->cover[i]);
    }
    return all;
}

std::vector<HeatState::Point> PointFacets::left() const {
    std::vector<HeatState::Point> left;
    for (const FacetPoint& p : point_) left.push_back(p.end);
    return left;
}

bool PointFacets::rests(const FacetPoint& p) const {
    if (!p.begun || p.kelvin.empty()) return false;
    const bool closed =
        p.residual <= solve_.options.tolerance && p.move <= move_of_point(solve_.options);
    if (solve_.options.periodic && !closed && !p.alternates) return false;
    const double counts = solve_.options.still_heat;  // as for blocks
    const std::vector<float>& relit = solve_.relit;
    if (!relit.empty() && std::max(relit[p.facet], relit[back_of_point(solve_, p)]) > counts) {
        return false;
    }
    if (solve_.excess.empty()) return true;
    for (std::size_t i = 0; i < p.excess.size(); ++i) {
        if (std::abs(solve_.excess.at(i, p.facet) - p.excess[i]) > counts) return false;
    }
    for (std::size_t i = 0; i < p.back_excess.size(); ++i) {
        const float now = solve_.excess.at(i, back_of_point(solve_, p));
        if (std::abs(now - p.back_excess[i]) > counts) return false;
    }
    return true;
}

double PointFacets::mean_kelvin(std::size_t facet) const {
    double mean = 0.0;
    const std::size_t instants = solve_.instant.size();
    for (std::size_t i = 0; i < instants; ++i) {
        mean += double(solve_.kelvin.at(i, facet)) / double(instants);
    }
    return mean;
}

/// A facet's way through the span, step by step and from edge to edge; Point::kelvin becomes what a
/// radiometer sees of it.
void PointFacets::march_span(const Level& level, const FacetForcing& forcing, PointFacet& facet,
                             FacetPoint& p, Eigen::MatrixXd* map) const {
    const std::vector<Instant>& edge = forcing.edges();
    const std::vector<Instant>& instant = solve_.instant;
    const auto record = [&](std::size_t i, const SurfaceTerms& terms, double taken) {
        if (!solve_.record || !solve_.record->wants(i)) return;
        HeatBalance balance = terms.balance;
        balance.conducted = -taken;
        solve_.record->put(i, p.facet, balance, -terms.frost_melt);
        if (p.back_kelvin.empty()) return;
        const Block& block = solve_.block[p.block];
        record_point_back(solve_, level.kind[block.material], block, p.lane, i,
                          forcing.behind(instant[i]), double(p.back_kelvin[i]));
    };
    facet.count = {};
    const SurfaceTerms first = facet.terms(instant[0]);
    p.kelvin[0] = float(first.radiometric);
    const ThermalSurface& surface =
        solve_.input.materials[solve_.input.facets.material[p.facet]].thermal;
    const StoreCapacity capacity =
        store_capacity(surface.store, solve_.input.facets.normal[p.facet].z());
    p.cover.resize(holds_water(surface) ? instant.size() : 0);
    const auto put_cover = [&](std::size_t i) {
        if (p.cover.empty()) return;
        p.cover[i] = surface_cover(surface, capacity, facet.standing, facet.snow_albedo());
    };
    put_cover(0);
    const std::size_t last = facet.column.size() - 1;
    const auto put_back = [&](std::size_t i) {
        if (p.back_kelvin.empty()) return;
        p.back_kelvin[i] = float(facet.column.temperature(last, facet.u[last]));
    };
    put_back(0);
    record(0, first, first.into_ground);
    std::size_t k = 0;
    bool restart = true;
    for (std::size_t i = 0; i + 1 < instant.size(); ++i) {
        Instant now = instant[i];
        for (; k < edge.size() && edge[k] < instant[i + 1]; ++k) {
            facet.march(now, edge[k], restart, map);
            now = edge[k];
            restart = true;
        }
        facet.march(now, instant[i + 1], restart, map);
        restart = false;
        p.kelvin[i + 1] = float(facet.terms(instant[i + 1]).radiometric);
        put_back(i + 1);
        put_cover(i + 1);
        record(i + 1, facet.ending().terms, facet.ending().taken);
    }
}

void PointFacets::run(const Level& level, FacetPoint& p) const {
    constexpr int most_passes = 8;  // at a time: neighbours change in between
    const Block& block = solve_.block[p.block];
    const MaterialColumn& column = level.kind[block.material].column;
    const std::size_t instants = solve_.instant.size();
    const FacetForcing forcing(solve_, weather_, block, p.lane);
    note_excess(solve_, p, forcing.has_other_side());
    if (forcing.has_other_side()) p.back_kelvin.resize(instants);
    std::function<double(Instant)> behind;
    if (forcing.has_back()) behind = [&](Instant when) { return forcing.behind(when); };
    PointFacet facet({.surface = column.surface,
                      .louis = column.louis,
                      .up_cosine = solve_.input.facets.normal[p.facet].z(),
                      .part = solve_.part_of(p.facet),
                      .wind_height = solve_.series.weather().wind_height,
                      .utc_offset = solve_.input.utc_offset,
                      .reference = column.reference,
                      .grid = grid_of_point(column.surface, solve_.options.grid),
                      .longest_step = solve_.step / solve_.options.refinement,
                      .forcing = [&](Instant when) { return forcing(when); },
                      .behind = behind,
                      .wet_behind = forcing.wet_behind()});
    if (p.begun) {
        facet.u = p.start.u;
        facet.standing = p.start.standing;
    } else {
        if (solve_.input.from) {
            take_over(profile_at_start(level.kind[block.material], block, p.lane), facet);
        } else {
            guess_state(column.surface, mean_kelvin(p.facet), facet);
        }
        p.begun = true;
    }
    p.kelvin.resize(instants);
    const bool periodic = solve_.options.periodic;
    double before = 1e9;
    bool astray = false, closed = false;
    for (int pass = 0; pass < most_passes; ++pass) {
        const std::vector<double> start = facet.u;
        const Standing stood = facet.standing;
        facet.set_snow_albedo(p.start.snow_albedo);
        const auto size = static_cast<Eigen::Index>(start.size());
        // Where a front of freezing passes other nodes than it did, the map before misleads: a
        // plain pass brings it closer, and needs no map.
        const bool newton = periodic && !astray && !p.alternates;
        Eigen::MatrixXd map;
        if (newton) map = Eigen::MatrixXd::Identity(size, size);
        march_span(level, forcing, facet, p, newton ? &map : nullptr);
        ++p.passes;
        p.count = facet.count;
        p.end = {p.facet, facet.u, facet.standing, facet.snow_albedo()};
        if (!periodic) {  // a span that does not repeat begins where it began
            facet.u = start;
            facet.standing = stood;
            break;
        }
        p.residual = facet.change_since(start);
        p.move = newton ? facet.close_period(start, map) : p.residual;
        astray = !astray && p.residual > 0.5 * before && !facet.column.linear();
        before = p.residual;
        for (std::size_t i = 0; p.alternates && i < start.size(); ++i) {
            facet.u[i] = 0.5 * (start[i] + facet.u[i]);
        }
        const bool store_settled = p.store.next(p.passes, stood, facet.standing);
        closed = p.residual <= solve_.options.tolerance &&
                 p.move <= move_of_point(solve_.options) && store_settled;
        if (closed) break;
    }
    if (periodic && !closed) note_alternating(p);
    p.start.u = facet.u;
    p.start.standing = facet.standing;
}

void PointFacets::run_groups(const Level& level, std::vector<FacetPoint*> waiting) {
    column_.resize(level.kind.size());
    const auto kind_of = [&](const FacetPoint* p) { return solve_.block[p->block].material; };
    const auto key = [&](const FacetPoint* p) {
        const Block& block = solve_.block[p->block];
        return std::tuple(block.material, block.behind.empty(), block.sheltered);
    };
    std::stable_sort(waiting.begin(), waiting.end(),
                     [&](const FacetPoint* a, const FacetPoint* b) { return key(a) < key(b); });
    // The more, the better the lanes are filled; the fewer, the better the processors.
    const auto number = std::size_t(std::count_if(waiting.begin(), waiting.end(),
                                                  [&](const FacetPoint* p) { return counts(*p); }));
    const std::size_t most = enthalpy_lanes * std::clamp<std::size_t>(number / 128, 2, 16);
    std::vector<std::span<FacetPoint* const>> group;
    for (std::size_t from = 0; from < waiting.size();) {
        std::size_t to = from + 1;
        while (to < waiting.size() && to - from < most && key(waiting[to]) == key(waiting[from])) {
            ++to;
        }
        group.push_back(std::span(waiting).subspan(from, to - from));
        std::optional<PointColumn>& column = column_[kind_of(waiting[from])];
        if (!column) {
            column.emplace(point_column(solve_, level.kind[kind_of(waiting[from])].column));
        }
        from = to;
    }
    for_each_index(
        group.size(),
        [&](std::size_t g) {
            run_point_group(solve_, level, *column_[kind_of(group[g][0])], weather_, group[g]);
        },
        1);
}

void PointFacets::pass(SolveState& solve, const Level& level) {
    take_in(level);
    std::vector<FacetPoint*> alone, together;
    for (FacetPoint& p : point_) {
        if (!solve_.record && rests(p)) continue;
        (by_itself(level, p) ? alone : together).push_back(&p);
        if (!solve.relit.empty()) solve.relit[p.facet] = solve.relit[back_of_point(solve, p)] = 0;
    }
    for_each_index(
        alone.size(), [&](std::size_t i) { run(level, *alone[i]); }, 1);
    run_groups(level, std::move(together));
    stores_ = batched_ = 0;
    for (const FacetPoint& p : point_) {
        if (!counts(p)) continue;
        const Kind& kind = level.kind[solve_.block[p.block].material];
        stores_ += kind.column.surface.store.capacity_mm > 0.0 ? 1 : 0;
        batched_ += by_itself(level, p) ? 0 : 1;
    }
    put(solve);
}

/// A sheet that evaporates on both sides is beyond what goes side by side, too.
bool PointFacets::by_itself(const Level& level, const FacetPoint& p) const {
    const Block& block = solve_.block[p.block];
    return !in_lanes(level.kind[block.material].column.surface) ||
           (!block.behind.empty() && back_of(solve_, block).wet);
}

void PointFacets::put(SolveState& solve) const {
    for (const FacetPoint& p : point_) {
        if (!p.kelvin.empty()) solve.kelvin.put(p.facet, p.kelvin.data());
        if (!p.back_kelvin.empty()) {
            solve.kelvin.put(back_of_point(solve_, p), p.back_kelvin.data());
        }
    }
}

PointFacets::Summary PointFacets::summary() const {
    Summary s = left_out_;
    s.fresh = fresh_;
    s.stores = stores_;
    s.batched = batched_;
    for (const FacetPoint& p : point_) {
        if (!counts(p)) continue;
        ++s.points;
        if (p.alternates) {
            ++s.alternating;
            if (p.residual > s.alternation) s.alternating_facet = p.facet;
            s.alternation = std::max(s.alternation, p.residual);
        } else {
            if (p.residual > s.residual) s.worst_facet = p.facet;
            s.residual = std::max(s.residual, p.residual);
            s.largest_move = std::max(s.largest_move, p.move);
        }
        s.stores_held += p.store.held ? 1 : 0;
        if (p.store.held) s.store_growth = std::max(s.store_growth, p.store.growth);
        s.worst_closure = std::max(s.worst_closure, p.count.worst_closure);
        s.worst_passes = std::max(s.worst_passes, p.passes);
        s.limited += p.count.limited;
        if (p.count.unsolved > 0 && s.unsolved == 0) {
            s.first_unsolved_facet = p.facet;
            s.first_unsolved = p.count.first_unsolved;
        }
        s.unsolved += p.count.unsolved;
        s.worst_water_closure = std::max(s.worst_water_closure, p.water_closure);
    }
    return s;
}

}  // namespace diurna
