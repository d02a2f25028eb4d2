#include "terrain/raster/dem_voids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

namespace {

struct Grid {
    int columns, rows;
    std::vector<float> value;
    float& at(int row, int column) { return value[std::size_t(row) * columns + column]; }
};

/// Means over 2 × 2 cells of what is valid there.
Grid halved(Grid& fine) {
    Grid coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
    coarse.value.resize(std::size_t(coarse.columns) * coarse.rows);
    for (int row = 0; row < coarse.rows; ++row) {
        for (int column = 0; column < coarse.columns; ++column) {
            double sum = 0.0;
            int count = 0;
            for (int r = 2 * row; r < std::min(fine.rows, 2 * row + 2); ++r) {
                for (int c = 2 * column; c < std::min(fine.columns, 2 * column + 2); ++c) {
                    if (std::isnan(fine.at(r, c))) continue;
                    sum += fine.at(r, c);
                    ++count;
                }
            }
            coarse.at(row, column) = count > 0 ? static_cast<float>(sum / count)
                                               : std::numeric_limits<float>::quiet_NaN();
        }
    }
    return coarse;
}

/// Bilinear between the centres of the coarse cells.
float interpolated(Grid& coarse, int fine_row, int fine_column) {
    const double y = std::clamp(0.5 * fine_row - 0.25, 0.0, coarse.rows - 1.0);
    const double x = std::clamp(0.5 * fine_column - 0.25, 0.0, coarse.columns - 1.0);
    const int r0 = static_cast<int>(y), c0 = static_cast<int>(x);
    const int r1 = std::min(r0 + 1, coarse.rows - 1), c1 = std::min(c0 + 1, coarse.columns - 1);
    const double v = y - r0, u = x - c0;
    return static_cast<float>((1 - v) * ((1 - u) * coarse.at(r0, c0) + u * coarse.at(r0, c1)) +
                              v * ((1 - u) * coarse.at(r1, c0) + u * coarse.at(r1, c1)));
}

void fill(Grid& grid) {
    const auto is_void = [](float h) { return std::isnan(h); };
    if (std::none_of(grid.value.begin(), grid.value.end(), is_void)) return;
    Grid coarse = halved(grid);
    fill(coarse);
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            float& height = grid.at(row, column);
            if (std::isnan(height)) height = interpolated(coarse, row, column);
        }
    }
}

}  // namespace

void fill_voids(int columns, int rows, std::vector<float>& height) {
    Grid grid{columns, rows, std::move(height)};
    fill(grid);
    height = std::move(grid.value);
}

}  // namespace diurna
