#pragma once

#include <cstddef>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Temperatures below a facet, on the straight line between depths, those at the ends beyond.
struct DepthProfile {
    std::vector<double> depth;   // [m] ascending
    std::vector<double> kelvin;  // of each
    double at(double metres) const;
};

/// What a block's state at the start of the span means below one of its facets.
DepthProfile profile_at_start(const Kind& kind, const Block& block, std::size_t lane);

}  // namespace diurna
