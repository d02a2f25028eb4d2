#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Runs one block of a layered material, of one in modes, or of plates over the span.
void run_layered(SolveState& solve, const Level& level, Block& block);
void run_modes(SolveState& solve, const Level& level, Block& block);
void run_plates(SolveState& solve, const Level& level, Block& block);

}  // namespace diurna
