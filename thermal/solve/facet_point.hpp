#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/point/store_start.hpp"
#include "thermal/solve/heat_state.hpp"
#include "thermal/solve/solve_state.hpp"
#include "thermal/surface/surface_cover.hpp"

namespace diurna {

/// A facet of a solve that needs more than its block provides (thermal/solve/point_facets.hpp).
struct FacetPoint {
    std::size_t facet, block, lane;
    bool begun = false;
    HeatState::Point start, end;
    std::vector<float> kelvin{}, excess{};            // (instant) of the last run; its input
    std::vector<float> back_kelvin{}, back_excess{};  // the same for its back, if it has one
    std::vector<SurfaceCover> cover{};                // (instant) of the last run; empty: no water
    double residual = 0.0, move = 0.0;                // [K]
    int passes = 0;
    PointFacet::Count count{};
    double water_closure = 0.0;     // [kg m⁻²] of the last run
    StoreStart store{};             // water and snow at the start of a periodic span
    bool alternates = false;        // passes are averaged: no start repeats
    double earlier_residual = 1e9;  // [K] at the end of the previous run of passes
};

/// After a run of passes without a periodic day: whether passes are averaged from now on. In calm
/// nights a surface may have two balances, and if the previous day decides between them, days
/// alternate; Newton's steps then oscillate without end.
inline void note_alternating(FacetPoint& p) {
    constexpr int enough_passes = 24;
    p.alternates =
        p.alternates || (p.passes >= enough_passes && p.residual > 0.5 * p.earlier_residual);
    p.earlier_residual = p.residual;
}

/// [K] A point whose start is to move by less is periodic.
inline double move_of_point(const SolveOptions& options) {
    return std::max(0.01, 0.2 * options.still);
}

/// The facet that is a point's back; without one the facet itself.
inline std::size_t back_of_point(const SolveState& solve, const FacetPoint& point) {
    const Block& block = solve.block[point.block];
    return block.behind.empty() ? point.facet : block.behind[point.lane];
}

/// Stores the neighbours' longwave under which a point runs.
inline void note_excess(const SolveState& solve, FacetPoint& p, bool has_back) {
    if (solve.excess.empty()) return;
    p.excess.resize(solve.instant.size());
    p.back_excess.resize(has_back ? p.excess.size() : 0);
    for (std::size_t i = 0; i < p.excess.size(); ++i) {
        const PackedField::Row row = solve.excess.row(i);
        p.excess[i] = row(p.facet);
        if (has_back) p.back_excess[i] = row(back_of_point(solve, p));
    }
}

/// The grid of a point's column: coarser for freezing water, because the front halts at every
/// node.
GridOptions grid_of_point(const ThermalSurface& surface, GridOptions grid);

}  // namespace diurna
