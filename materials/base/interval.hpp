#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace diurna {

/// The i of the interval [edge i, edge i + 1) between ascending edges, two or more, that holds x;
/// the first and the last also hold what lies beyond.
inline std::size_t interval_of(std::span<const double> edge, double x) {
    const auto above = std::upper_bound(edge.begin() + 1, edge.end() - 1, x);
    return static_cast<std::size_t>(above - edge.begin()) - 1;
}

}  // namespace diurna
