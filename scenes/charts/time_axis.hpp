#pragma once

#include <string>
#include <utility>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// The scene's clock along a chart: x are hours after `start`.
struct TimeAxis {
    Instant start{};
    double hours = 0.0;
    double utc_offset = 0.0;  // [s]
    std::string title;
    /// Ticks at whole hours, days or minutes, at most 13: "06:00", at midnights "16
    /// July".
    std::vector<std::pair<double, std::string>> ticks{};

    double x(Instant when) const { return seconds_between(start, when) / 3600.0; }
    bool days() const { return hours > 24.0; }
    /// "05:12"; for spans of more than a day "15 July 05:12".
    std::string says(Instant when) const;
};
TimeAxis time_axis(Instant start, Instant end, double utc_offset);

}  // namespace diurna
