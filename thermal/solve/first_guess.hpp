#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// A material's states in balance with a surface one kelvin above the reference.
Eigen::VectorXd steady_states(const Kind& kind);

/// First guess: every facet's steady state under its mean input over the span.
void settle(SolveState& solve, Level& level);

}  // namespace diurna
