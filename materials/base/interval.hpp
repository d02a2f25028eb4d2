#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace diurna {

/// Index i of the interval [edge i, edge i + 1) that holds x, for two or more ascending edges; the
/// first and the last interval include everything outside.
inline std::size_t interval_of(std::span<const double> edge, double x) {
    const auto above = std::upper_bound(edge.begin() + 1, edge.end() - 1, x);
    return static_cast<std::size_t>(above - edge.begin()) - 1;
}

}  // namespace diurna
