#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/plan/prepared.hpp"
#include "scenes/report/curves.hpp"

namespace diurna {

/// Curves that belong together, and what is known of them all.
struct GroupDays {
    const Prepared& prepared;
    const std::vector<Instant>& instants;
    /// Whose crossings with the others are reported: the material around. None: nobody's.
    const std::optional<DiurnalCurve>& around;
};

/// The curves of groups and of the air over the span, those far from the others on a scale of
/// their own, with the times at which each crosses `around`; below them coldest, warmest, spread
/// and the same times as a table. HTML.
///
/// - title: of the chart
/// - what: the table's first column, "material"
std::string group_days(const GroupDays& days, const std::string& title, const std::string& what,
                       const std::vector<DiurnalCurve>& curves);

/// What curves of so few instants are, where more than half an hour lies between some; "" else.
std::string between_instants(const std::vector<Instant>& instants);

/// Colours of the materials that many scenes have, and of air; the others take theirs in turn.
std::string colour_of(const std::string& name, std::size_t turn = 0);

}  // namespace diurna
