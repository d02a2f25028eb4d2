#pragma once

#include <string>

#include "scenes/charts/chart_parts.hpp"

namespace diurna {

/// The chart as an SVG element: axes with round ticks, a grid, one line per series, each with its
/// name at its end, connected to it by a line if names had to be moved apart.
std::string svg(const Chart& chart);

/// Height of the drawing [px].
int drawn_height(const Chart& chart);

}  // namespace diurna
