#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Fills the solve's sunlight at every instant: sun, sky and what facets reflect.
void shine(SolveState& solve);
/// Sunlight that jumps at the shadows' edges: what falls on the facet with the sun's whole disc
/// less what falls on it with none, times the change of the share.
void find_jumps(SolveState& solve);
/// What each facet sees of a sky brighter towards the horizon, where any instant's is.
std::vector<float> tilts(const SolveState& solve);

}  // namespace diurna
