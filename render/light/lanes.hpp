#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace diurna {

/// Numbers in a vector register: tables for the innermost loops are padded with zeros to whole
/// registers.
inline constexpr std::size_t lane_count = 8;
using Lane = Eigen::Array<float, lane_count, 1>;
inline Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

/// The smallest multiple of `group` that is at least n.
inline constexpr std::size_t rounded_up(std::size_t n, std::size_t group = lane_count) {
    return (n + group - 1) / group * group;
}

}  // namespace diurna
