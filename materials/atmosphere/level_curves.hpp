#pragma once

#include <span>
#include <vector>

#include "materials/base/monotone_cubic.hpp"

namespace diurna {

/// Values at levels, (level)(column), and the smooth monotone curve through each column.
struct LevelCurves {
    std::vector<std::vector<double>> value, slope;

    void assign(std::size_t levels, std::size_t columns) {
        value.assign(levels, std::vector<double>(columns, 0.0));
    }
    /// To be called after the values are set.
    void find_slopes(std::span<const double> level_km);
    double at(const HermiteWeights& w, std::size_t column) const {
        return w.value_low * value[w.low][column] + w.slope_low * slope[w.low][column] +
               w.value_high * value[w.low + 1][column] + w.slope_high * slope[w.low + 1][column];
    }
};

}  // namespace diurna
