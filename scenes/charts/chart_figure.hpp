#pragma once

#include <string>

#include "scenes/charts/chart_parts.hpp"

namespace diurna {

/// A chart under its title as HTML, in a version for wide and one for narrow screens; the page
/// shows the one that fits.
std::string chart_figure(const Chart& chart);

}  // namespace diurna
