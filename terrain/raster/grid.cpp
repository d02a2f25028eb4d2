#include "terrain/raster/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

Grid halved(const Grid& fine) {
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

}  // namespace diurna
