#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/charts/curves.hpp"
#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Curves of one chart, and their common data.
struct GroupDays {
    const Prepared& prepared;
    const std::vector<Instant>& instants;
    /// The curve whose crossings are reported: the surrounding material's. None: no
    /// report.
    const std::optional<DiurnalCurve>& around;
};

/// The curves of groups and of the air over the span, those far from the others on a separate
/// scale, with the times at which each crosses `around`; below them coldest, warmest, spread and
/// the same times as a table. HTML.
///
/// - title: of the chart
/// - what: the table's first column, "material"
std::string group_days(const GroupDays& days, const std::string& title, const std::string& what,
                       const std::vector<DiurnalCurve>& curves);

/// How far apart the instants are between which times of crossings are linear; "" for one instant.
std::string between_instants(const std::vector<Instant>& instants);

/// Colours of common materials, and of air; the others use further colours in turn.
std::string colour_of(const std::string& name, std::size_t turn = 0);

}  // namespace diurna
