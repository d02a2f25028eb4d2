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
};

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
