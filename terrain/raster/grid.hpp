#pragma once

#include <cstddef>
#include <vector>

namespace diurna {

/// Values over a grid, (row, column); NaN: no value.
struct Grid {
    int columns = 0, rows = 0;
    std::vector<float> value;

    float at(int row, int column) const { return value[std::size_t(row) * columns + column]; }
    float& at(int row, int column) { return value[std::size_t(row) * columns + column]; }
};

/// Half as fine: means of the valid values of 2 × 2 cells.
Grid halved(const Grid& fine);

/// Interpolates within a cell, a and b its upper corners, c and d its lower; u across, v down (0 to
/// 1).
inline double bilinear(double a, double b, double c, double d, double u, double v) {
    return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
}

}  // namespace diurna
