#pragma once

#include <string>

#include "scenes/report/chart_parts.hpp"

namespace diurna {

/// A chart under its title as HTML, drawn for a desk and for a phone; a page shows the one that
/// fits.
std::string chart_figure(const Chart& chart);

}  // namespace diurna
