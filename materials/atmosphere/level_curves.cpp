#include "materials/atmosphere/level_curves.hpp"

namespace diurna {

void LevelCurves::find_slopes(std::span<const double> level_km) {
    const std::size_t levels = value.size(), columns = value.front().size();
    slope.assign(levels, std::vector<double>(columns));
    std::vector<double> column(levels);
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; i < levels; ++i) column[i] = value[i][c];
        const std::vector<double> slopes = monotone_slopes(level_km, column);
        for (std::size_t i = 0; i < levels; ++i) slope[i][c] = slopes[i];
    }
}

}  // namespace diurna
