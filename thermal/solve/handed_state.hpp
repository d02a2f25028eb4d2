#pragma once

#include "thermal/solve/heat_state.hpp"
#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/packed_field.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/solve_state.hpp"
#include "thermal/solve/time_level.hpp"

/// The state that one solve leaves and the next begins with.
namespace diurna {

/// Begins with what another solve has left, in place of the first guess. Throws InputError if that
/// has other facets or columns. Returns whether `guess` was taken.
///
/// - guess: temperatures of a similar day; taken if it has the same facets and instants
bool set_out_from(const HeatState& from, PackedField guess, SolveState& solve);

/// What the span leaves. A periodic one ends where it starts.
HeatState left_by(SolveState& solve, const Level& level, const PointFacets& points,
                  const NetworkFacets& targets);

}  // namespace diurna
