#pragma once

#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Dew and hoar that a facet's surface would gather over the span, as warm as the solve has it now.
struct Dew {
    double most_warming = 0.0;  // [K] that its heat is worth at the most, were the ground a void
    double gathered = 0.0;      // [kg m⁻²]
};
/// warmest  (instant) [K] from warmest_dew: warmer surfaces gather none
Dew dew_on(const SolveState& solve, const Kind& kind, const Block& block, std::size_t lane,
           const std::vector<double>& warmest);
/// (instant) [K] A kelvin and a half over the dew point of a block's lower air.
std::vector<double> warmest_dew(const SolveState& solve, const Kind& kind, const Block& block);

}  // namespace diurna
