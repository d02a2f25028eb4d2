#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace diurna {

struct ChartLine {
    std::string name;
    std::string colour;        // "#rrggbb"
    std::vector<double> x, y;  // equally long
    bool dashed = false;
};

/// A marked point of a line, and its tooltip.
struct ChartMark {
    std::size_t line = 0;
    double x = 0.0, y = 0.0;
    std::string says;
};

/// Events in a separate row below the lines: (x, text beside the tick).
struct ChartRow {
    std::string name, colour;
    std::vector<std::pair<double, std::string>> event;
};

struct Chart {
    std::string title /* "": none */, x_title, y_title;
    double x_first = 0.0, x_last = 1.0, x_tick = 1.0;
    std::vector<ChartLine> lines;
    int width = 860, height = 420;                        // [px]; drawn higher if names need room
    std::vector<std::pair<double, std::string>> ticks{};  // of x, replacing every x_tick
    std::vector<ChartMark> marks{};
    std::string rows_title{};
    std::vector<ChartRow> rows{};
    bool outliers_apart = false;  // lines far from the others get their own scale
    bool narrow = false;          // small margins, short names, fewer ticks: for phones
};

}  // namespace diurna
