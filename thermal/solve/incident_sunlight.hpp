#pragma once

#include "thermal/covered_facets.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Takes over the shares in the sun (SolveState::shares) from the input, which is not read again.
void store_shares(SolveState& solve);
/// Computes the solve's sunlight at every instant: sun, sky and reflections, with the snow and
/// water on the facets (SolveState::changing).
void add_sunlight(SolveState& solve);
/// Water and snow on facets at the span's start, if it continues from another span: their first
/// guess for all instants.
void take_earlier_water(SolveState& solve);
/// Recomputes sunlight if snow and water on facets have changed. Returns the largest change of
/// absorbed light on any facet, dry [W m⁻²]; 0 if no facet receives reflected light.
double relight(SolveState& solve, const CoveredFacets& water);
/// Jumps of sunlight at the shadows' edges: incident light with the whole disc of the sun minus
/// that without it, times the change of the share.
void find_jumps(SolveState& solve);
/// Each facet's view of the sky's horizon brightening, if any instant has one.
std::vector<float> tilts(const SolveState& solve);

}  // namespace diurna
