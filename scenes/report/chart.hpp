#pragma once

#include <string>

#include "scenes/report/chart_parts.hpp"

namespace diurna {

/// The chart as an SVG element: axes with round ticks, a grid, one line a series, each with its
/// name at its end, joined to it where names had to make room for each other.
std::string svg(const Chart& chart);

/// How high it is drawn [px].
int drawn_height(const Chart& chart);

}  // namespace diurna
