#pragma once

#include <string>
#include <vector>

#include "scenes/plan/prepared.hpp"
#include "scenes/report/curves.hpp"

namespace diurna {

/// The curves of all materials and of the air over the hours of the span, as an SVG element.
std::string curves_chart(const Prepared& prepared, const std::vector<Instant>& instants,
                         const std::vector<DiurnalCurve>& curves);

/// Coldest, warmest, spread, and where each material's curve crosses that of `background`, as an
/// HTML table. utc_offset: [s] of the clock that crossings are told by.
std::string curves_table(const std::vector<Instant>& instants,
                         const std::vector<DiurnalCurve>& curves, const std::string& background,
                         double utc_offset);

}  // namespace diurna
