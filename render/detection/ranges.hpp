#pragma once

#include <functional>

namespace diurna {

/// The farthest range [m] within `from` to `to` up to which what falls with range is at least
/// `wanted`: 0 where it is less at `from` already, `to` where it is not less anywhere; to 1e-9 of
/// itself.
double farthest_range(const std::function<double(double)>& falling, double wanted, double from,
                      double to);

}  // namespace diurna
