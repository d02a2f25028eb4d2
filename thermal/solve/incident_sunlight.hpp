#pragma once

#include "thermal/covered_facets.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Fills the solve's sunlight at every instant: sun, sky and what facets reflect, with what lies on
/// them (SolveState::changing).
void add_sunlight(SolveState& solve);
/// What lay on facets at the span's start, if it goes on from another: their first guess
/// throughout.
void take_earlier_water(SolveState& solve);
/// Shines anew if what lies on facets is no longer what sunlight went by. Returns the largest
/// change of what any facet takes in, dry [W m⁻²]; 0 where nothing reflects light onto anything.
double relight(SolveState& solve, const CoveredFacets& water);
/// Sunlight that jumps at the shadows' edges: what falls on the facet with the sun's whole disc
/// less what falls on it with none, times the change of the share.
void find_jumps(SolveState& solve);
/// What each facet sees of a sky brighter towards the horizon, where any instant's is.
std::vector<float> tilts(const SolveState& solve);

}  // namespace diurna
