#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/run/rounds.hpp"
#include "scenes/job/store/messages.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// What is reported of a heat balance: by the run that solved it, and by later ones that take its
/// temperatures from a folder or the cache.
struct HeatReport {
    std::string not_converged{};  // in one line; "" if it converged
    std::string start{};          // how the start was found, and its effect
    std::vector<std::string> notes{};
    std::vector<std::pair<std::string, std::string>> rows{};  // of the report's table of errors
    /// pictures_key() of the pictures in which check points were drawn
    /// (scenes/job/run/check_error.hpp); "": none were.
    std::string checked_in{};
    Round next{};  // that the check points ask for (scenes/job/run/rounds.hpp)
};

HeatReport heat_report(const Prepared& prepared, const SpanResult& result);

/// Says that the facets' error was not measured if the check points were drawn in the pictures of
/// another scene.
void drop_check_of_others(const Prepared& prepared, HeatReport& report);

/// As a ledger and the cache keep it.
Messages as_messages(const HeatReport& report);
HeatReport heat_report_of(const Messages& messages);

}  // namespace diurna
