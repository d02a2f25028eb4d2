#pragma once

#include <span>
#include <vector>

#include "thermal/solve/point_column.hpp"

namespace diurna {

/// Runs points of one material through the span, `enthalpy_lanes` at a time; a periodic span until
/// it closes (thermal/solve/period_search.hpp), at most eight times. Each has its own steps; when
/// one is finished, the next takes its lane. A point begins from its block's state.
///
/// weather  at the solve's instants
/// point    all with backs or none, all of sheltered ground or none
void run_point_group(const SolveState& solve, const Level& level, const PointColumn& column,
                     const std::vector<Forcing>& weather, std::span<FacetPoint* const> point);

}  // namespace diurna
