#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "terrain/raster/dem.hpp"

namespace diurna {

/// The post of a raster farthest from a triangle, measured vertically.
struct WorstPost {
    double error = -1.0;  // [m]; negative where the triangle covers no post
    int column = 0, row = 0;
};

/// The scan with or without weights; the loops over a row are vectorised.
template <bool weighted>
WorstPost scan_posts(const Dem& dem, std::array<Eigen::Vector3d, 3> corner, const float* weight) {
    std::sort(corner.begin(), corner.end(),
              [](const auto& a, const auto& b) { return a.y() < b.y(); });
    const auto& [top, middle, bottom] = corner;
    const Eigen::Vector3d normal = (middle - top).cross(bottom - top);
    WorstPost worst;
    if (std::abs(normal.z()) < 1e-9) return worst;  // no post inside, only on its border
    const double per_column = -normal.x() / normal.z(), per_row = -normal.y() / normal.z();
    const auto slope = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
        return to.y() > from.y() ? (to.x() - from.x()) / (to.y() - from.y()) : 0.0;
    };
    const double long_side = slope(top, bottom), upper = slope(top, middle),
                 lower = slope(middle, bottom);
    constexpr double rounding = 1e-9;  // [posts] a post on an edge belongs to both triangles

    const int first_row = std::max(0, static_cast<int>(std::ceil(top.y() - rounding)));
    const int last_row =
        std::min(dem.rows - 1, static_cast<int>(std::floor(bottom.y() + rounding)));
    for (int row = first_row; row <= last_row; ++row) {
        const double y = std::clamp(static_cast<double>(row), top.y(), bottom.y());
        const bool above = y < middle.y() || middle.y() == bottom.y();
        const double a = top.x() + (y - top.y()) * long_side;
        const double b =
            above ? top.x() + (y - top.y()) * upper : middle.x() + (y - middle.y()) * lower;
        const int first = std::max(0, static_cast<int>(std::ceil(std::min(a, b) - rounding)));
        const int last =
            std::min(dem.columns - 1, static_cast<int>(std::floor(std::max(a, b) + rounding)));
        const float* height = dem.height.data() + std::size_t(row) * dem.columns;
        const double start = top.z() + per_row * (row - top.y()) - per_column * top.x();

        const float* weights = weighted ? weight + std::size_t(row) * dem.columns : nullptr;
        const auto error_at = [&](int column) {
            const double error = std::abs(start + per_column * column - height[column]);
            if constexpr (weighted) return error * weights[column];
            return error;
        };

        double row_error = -1.0;
#pragma omp simd reduction(max : row_error)
        for (int column = first; column <= last; ++column) {
            const double error = error_at(column);
            row_error = error > row_error ? error : row_error;
        }
        if (row_error <= worst.error) continue;
        worst = {row_error, first, row};
        for (int column = first; column <= last; ++column) {
            if (error_at(column) >= row_error) {
                worst.column = column;
                break;
            }
        }
    }
    return worst;
}

/// Scans the posts under a triangle of (column, row, height) corners, border included. Posts
/// without height must not be under it. If several are equally far, the first in row order is
/// returned. `weight` (row, column), if not empty, multiplies the error of each post.
inline WorstPost worst_post(const Dem& dem, const std::array<Eigen::Vector3d, 3>& corner,
                            std::span<const float> weight) {
    return weight.empty() ? scan_posts<false>(dem, corner, nullptr)
                          : scan_posts<true>(dem, corner, weight.data());
}

}  // namespace diurna
