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
    /// All columns at one height, for loops over them.
    struct Row {
        const double *low, *slope_low, *high, *slope_high;
        double of_low, of_slope_low, of_high, of_slope_high;

        double operator[](std::size_t column) const {
            return of_low * low[column] + of_slope_low * slope_low[column] +
                   of_high * high[column] + of_slope_high * slope_high[column];
        }
    };
    Row row(const HermiteWeights& w) const {
        return {value[w.low].data(),
                slope[w.low].data(),
                value[w.low + 1].data(),
                slope[w.low + 1].data(),
                w.value_low,
                w.slope_low,
                w.value_high,
                w.slope_high};
    }
    double at(const HermiteWeights& w, std::size_t column) const { return row(w)[column]; }
};

}  // namespace diurna
