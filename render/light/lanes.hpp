#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace diurna {

/// Numbers side by side in a register: tables that are read in the innermost loops come in whole
/// registers, zeros to spare.
inline constexpr std::size_t lane_count = 8;
using Lane = Eigen::Array<float, lane_count, 1>;
inline Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

/// The least multiple of `group` that is not below n.
inline constexpr std::size_t rounded_up(std::size_t n, std::size_t group = lane_count) {
    return (n + group - 1) / group * group;
}

}  // namespace diurna
