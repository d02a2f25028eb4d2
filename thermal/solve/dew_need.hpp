#pragma once

#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Dew and hoar that a facet's surface would gather over the span at its present temperature.
struct Dew {
    double most_warming = 0.0;  // [K] upper limit of its heat's effect, over insulating ground
    double gathered = 0.0;      // [kg m⁻²]
};
/// warmest  (instant) [K] from warmest_dew: warmer surfaces gather no dew
Dew dew_on(const SolveState& solve, const Kind& kind, const Block& block, std::size_t lane,
           const std::vector<double>& warmest);
/// (instant) [K] 1.5 K above the dew point of a block's lower air.
std::vector<double> warmest_dew(const SolveState& solve, const Kind& kind, const Block& block);

}  // namespace diurna
