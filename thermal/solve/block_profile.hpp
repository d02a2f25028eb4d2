#pragma once

#include <cstddef>
#include <vector>

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Temperatures below a facet, linear between depths, constant outside.
struct DepthProfile {
    std::vector<double> depth;   // [m] ascending
    std::vector<double> kelvin;  // of each
    double at(double metres) const;
};

/// Temperatures below one facet from a block's state at the start of the span.
DepthProfile profile_at_start(const Kind& kind, const Block& block, std::size_t lane);

}  // namespace diurna
