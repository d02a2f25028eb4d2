#pragma once

#include <optional>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// Hours at which something runs, on a local clock, every day or on one date.
struct ClockHours {
    struct Window {
        double from, to;            // [s] of the day; `to` beyond a day continues after midnight
        double share = 1.0;         // of full power
        std::optional<long> day{};  // since 1970-01-01 on that clock; none: every day
    };
    std::vector<Window> window{};  // empty: always at full power
    double utc_offset = 0.0;       // [s] that the clock is ahead of UTC

    /// The mean share from one instant to a later one. Windows must not overlap.
    double mean(Instant from, Instant to) const;
};

}  // namespace diurna
