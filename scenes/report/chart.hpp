#pragma once

#include <string>
#include <vector>

namespace diurna {

struct ChartLine {
    std::string name;
    std::string colour;        // "#rrggbb"
    std::vector<double> x, y;  // equally long
    bool dashed = false;
};

struct Chart {
    std::string title, x_title, y_title;
    double x_first = 0.0, x_last = 1.0, x_tick = 1.0;
    std::vector<ChartLine> lines;
    int width = 860, height = 420;  // [px]
};

/// The chart as an SVG element: axes with round ticks, a grid, one line a series, names at the
/// right where the lines end.
std::string svg(const Chart& chart);

}  // namespace diurna
