#include "materials/atmosphere/level_curves.hpp"

#include <cassert>
#include <cmath>

namespace diurna {

void LevelCurves::find_slopes(std::span<const double> level_km) {
    const std::size_t levels = value.size(), columns = value.front().size();
    slope.assign(levels, std::vector<double>(columns));
    // As monotone_slopes() does it, level after level, so that columns are done together.
    assert(levels > 2);
    for (std::size_t i = 1; i + 1 < levels; ++i) {
        const double below = level_km[i] - level_km[i - 1], above = level_km[i + 1] - level_km[i];
        const double a = 2.0 * above + below, b = above + 2.0 * below;
        const double *const low = value[i - 1].data(), *const here = value[i].data(),
                            *const high = value[i + 1].data();
        double* const out = slope[i].data();
#pragma omp simd
        for (std::size_t c = 0; c < columns; ++c) {
            const double before = (here[c] - low[c]) / below, after = (high[c] - here[c]) / above;
            const bool turns = before * after <= 0.0;
            const double mean = (a + b) / (a / (turns ? 1.0 : before) + b / (turns ? 1.0 : after));
            out[c] = turns ? 0.0 : mean;
        }
    }
    const auto end_slopes = [&](std::size_t end, std::size_t next, std::size_t inner) {
        const double near = level_km[next] - level_km[end], far = level_km[inner] - level_km[next];
        for (std::size_t c = 0; c < columns; ++c) {
            slope[end][c] = monotone_end_slope(std::abs(near), std::abs(far),
                                               (value[next][c] - value[end][c]) / near,
                                               (value[inner][c] - value[next][c]) / far);
        }
    };
    end_slopes(0, 1, 2);
    end_slopes(levels - 1, levels - 2, levels - 3);
}

}  // namespace diurna
