#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scenes/charts/chart_parts.hpp"

/// Positions of the parts of a chart, in pixels from its upper left corner.
namespace diurna {

inline constexpr double label_gap = 15.0;  // from one line of text to the next
inline constexpr double letter = 7.0;      // width of a wide letter at 12 px

/// The step among 1, 2, 5 times a power of ten that divides `span` into about `count` parts.
double round_step(double span, int count);

/// Positions nearest to the given ones (least squares) with a distance of at least `gap`, in the
/// same order, within the ends: (i) like `wanted`. There must be room for all.
std::vector<double> spread(const std::vector<double>& wanted, double gap, double lowest,
                           double highest);

/// Least and greatest of a line.
struct Extent {
    double low, high;
};

/// Which lines share a scale: indices, the largest first. Up to half of the lines, the highest or
/// the lowest ones, get a separate scale if the others then fill theirs 1.5 times better, or, for
/// one line between the others, 3 times; three scales at most.
std::vector<std::vector<std::size_t>> scales_apart(const std::vector<Extent>& lines);

/// One scale with its lines.
struct Panel {
    std::vector<std::size_t> line;
    double low, high, step;  // of its scale
    double top, height;
};

struct ChartLayout {
    double left = 62.0, right = 150.0, top = 34.0;  // margins
    std::size_t letters = 30;                       // of a name at most
    double width = 0.0;                             // of the frame
    std::vector<Panel> panel;
    double rows_top = 0.0, row_height = 0.0;
    double foot = 0.0;  // lower end, with the ticks of x
    int height = 0;     // of the whole
};
ChartLayout layout_of(const Chart& chart);

/// The ticks of x: fewer if their labels do not fit the frame.
std::vector<std::pair<double, std::string>> ticks_of(const Chart& chart, double width);

/// The visible part of a line in a frame of this width: for points closer than half a pixel, their
/// minimum and maximum.
ChartLine thinned(const ChartLine& line, const Chart& chart, double width);

/// Positions of the texts of a row's events, from left to right: beside the tick, to its right or
/// (beyond `end`) to its left, in one of two levels, -1 if both are occupied: then only the tick is
/// drawn.
struct EventText {
    int level = -1;
    bool leftward = false;
};
std::vector<EventText> event_texts(const std::vector<double>& x, const std::vector<double>& width,
                                   double end);

/// A name shortened to this many letters, with "…".
std::string shortened(const std::string& name, std::size_t letters);
std::size_t letters_of(const std::string& name);

}  // namespace diurna
