#pragma once

#include <cstddef>
#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/solve/heat_state.hpp"
#include "thermal/solve/solve_state.hpp"
#include "thermal/surface/surface_cover.hpp"

namespace diurna {

/// A facet of a solve that needs more than its block gives it (thermal/solve/point_facets.hpp).
struct FacetPoint {
    std::size_t facet, block, lane;
    bool begun = false;
    HeatState::Point start, end;
    std::vector<float> kelvin{}, excess{};  // (instant) of the last run; what it ran under
    std::vector<float> back_kelvin{}, back_excess{};  // the same of its back, if it has one
    std::vector<SurfaceCover> cover{};  // (instant) of the last run; none: it holds no water
    double residual = 0.0, move = 0.0;  // [K]
    int passes = 0;
    PointFacet::Count count{};
    double water_closure = 0.0;  // [kg m⁻²] of the last run
    bool store_held = false;     // what lies at the start is no longer that of the end
    double store_growth = 0.0;   // [mm] by which what lies has changed over the last run
};

/// What lies on a facet at the start of the next pass of a periodic span: what the pass before has
/// left. Where hoar or snow grows or melts on from day to day no repeated day exists for it, and
/// what `most_store_days` days have left is held as the start; temperatures then have a period.
///
/// stood    what lay at the start of the last pass
/// left     what lay at its end; becomes the next start
/// returns  whether the store at the start is settled
inline bool next_store(FacetPoint& p, const Standing& stood, Standing& left) {
    constexpr int most_store_days = 8;
    constexpr double settled = 1e-3;  // [mm]
    p.store_growth = apart(left, stood);
    if (p.store_held) {
        left = stood;
        return true;
    }
    if (p.store_growth <= settled) return true;
    p.store_held = p.passes >= most_store_days;
    return false;
}

/// The facet that is a point's back; none: the facet itself.
inline std::size_t back_of_point(const SolveState& solve, const FacetPoint& point) {
    const Block& block = solve.block[point.block];
    return block.behind.empty() ? point.facet : block.behind[point.lane];
}

/// Writes down under what of the neighbours' heat a point runs.
inline void note_excess(const SolveState& solve, FacetPoint& p, bool has_back) {
    if (solve.excess.empty()) return;
    p.excess.resize(solve.instant.size());
    p.back_excess.resize(has_back ? p.excess.size() : 0);
    for (std::size_t i = 0; i < p.excess.size(); ++i) {
        const float* const row = solve.excess.data() + i * solve.facets;
        p.excess[i] = row[p.facet];
        if (has_back) p.back_excess[i] = row[back_of_point(solve, p)];
    }
}

/// The grid of a point's column: a surface whose water freezes halts at every node the front
/// crosses.
GridOptions grid_of_point(const ThermalSurface& surface, GridOptions grid);

}  // namespace diurna
