#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// One pass over the span for all blocks that have not converged: stores their temperatures,
/// changes and surface slopes.
void pass(SolveState& solve, const Level& level, double progress_from, double progress_to);

}  // namespace diurna
