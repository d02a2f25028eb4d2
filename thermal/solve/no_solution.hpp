#pragma once

#include <string>

#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Throws std::runtime_error if the mean balance of the span has no solution: then a periodic span
/// has none either.
void check_mean_balance(const SolveState& solve);

/// Throws std::runtime_error with facet, material and instant if a temperature of a solve is not a
/// number (its neighbours' longwave is then invalid too).
void check_numbers(const SolveState& solve);

/// Names a facet, its material and an instant whose balance has no solution from 1 to 5000 K, or a
/// target; "" if all have one.
std::string without_solution(const SolveState& solve, const PointFacets::Summary& points,
                             const NetworkFacets::Summary& targets);

}  // namespace diurna
