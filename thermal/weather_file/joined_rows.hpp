#pragma once

#include <cstddef>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

inline constexpr std::size_t no_row = static_cast<std::size_t>(-1);

/// The rows of two ascending series in one order, each instant once.
struct JoinedRows {
    std::vector<Instant> stamp;              // (row)
    std::vector<std::size_t> first, second;  // (row) index in each series; no_row: absent
};

inline JoinedRows joined_rows(const std::vector<Instant>& a, const std::vector<Instant>& b) {
    JoinedRows rows;
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
        const bool take_a = k == b.size() || (i < a.size() && a[i] <= b[k]);
        const bool take_b = i == a.size() || (k < b.size() && b[k] <= a[i]);
        rows.stamp.push_back(take_a ? a[i] : b[k]);
        rows.first.push_back(take_a ? i++ : no_row);
        rows.second.push_back(take_b ? k++ : no_row);
    }
    return rows;
}

}  // namespace diurna
