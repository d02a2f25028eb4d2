#pragma once

#include <string>

#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Throws std::runtime_error where the balance of the span's mean has no solution: nor has a span
/// that repeats.
void check_mean_balance(const SolveState& solve);

/// Throws std::runtime_error, which names facet, material and instant, where a temperature of a
/// solve is no number: what neighbours sent it for then is none of theirs either.
void check_numbers(const SolveState& solve);

/// In words a facet, its material and an instant whose balance has no solution from 1 to 5000 K, or
/// a target's; "" where all has one.
std::string without_solution(const SolveState& solve, const PointFacets::Summary& points,
                             const NetworkFacets::Summary& targets);

}  // namespace diurna
