#pragma once

#include <array>
#include <span>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// A relief on a grid of equal steps [m], first post in the north-west at the origin.
inline HeightField even_field(int columns, int rows, std::span<const float> up, double step) {
    std::array<Eigen::Vector2d, 9> plan;
    for (int k = 0; k < 9; ++k) {
        plan[std::size_t(k)] = {step * (columns - 1) * (k % 3) / 2.0,
                                -step * (rows - 1) * (k / 3) / 2.0};
    }
    return {columns, rows, up, plan};
}

}  // namespace diurna
