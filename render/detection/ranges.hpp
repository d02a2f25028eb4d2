#pragma once

#include <functional>

namespace diurna {

/// The farthest range [m] within `from` to `to` at which a function that falls with range is at
/// least `wanted`: 0 if it is less at `from` already, `to` if it is never less; to a relative
/// 1e-9.
double farthest_range(const std::function<double(double)>& falling, double wanted, double from,
                      double to);

}  // namespace diurna
