#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scenes/report/chart_parts.hpp"

/// Where the parts of a chart lie, in pixels from its upper left corner.
namespace diurna {

inline constexpr double label_gap = 15.0;  // from one line of text to the next
inline constexpr double letter = 7.0;      // a letter's width at 12 px, the widest usual

/// The step among 1, 2, 5 times a power of ten that divides `span` into about `count` parts.
double round_step(double span, int count);

/// Places as near to the wanted ones (least squares) as a distance of `gap` between them allows,
/// in their order, none beyond the ends: (i) like `wanted`. Needs room for all.
std::vector<double> spread(const std::vector<double>& wanted, double gap, double lowest,
                           double highest);

/// Least and greatest of a line.
struct Extent {
    double low, high;
};

/// Which lines share a scale: indices, the greatest first. Up to half of the lines, the highest or
/// the lowest ones, go apart where the others then fill their scale 1.5 times better, or, for one
/// line that comes among the others, 3 times; three scales at most.
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
    double foot = 0.0;  // lower end of all, where ticks of x stand
    int height = 0;     // of the whole
};
ChartLayout layout_of(const Chart& chart);

/// The ticks of x: fewer where the frame has no room for their words.
std::vector<std::pair<double, std::string>> ticks_of(const Chart& chart, double width);

/// What is to be seen of a line in a frame so wide: of points nearer to each other than half a
/// pixel the least and the greatest.
ChartLine thinned(const ChartLine& line, const Chart& chart, double width);

/// Where the text of a row's events stands, from left to right: beside its tick, to the right or
/// where that is beyond `end` to the left, in one of two levels, -1 where both are taken: then its
/// tick is all there is.
struct EventText {
    int level = -1;
    bool leftward = false;
};
std::vector<EventText> event_texts(const std::vector<double>& x, const std::vector<double>& width,
                                   double end);

/// A name of at most so many letters, the rest as "…".
std::string shortened(const std::string& name, std::size_t letters);
std::size_t letters_of(const std::string& name);

}  // namespace diurna
