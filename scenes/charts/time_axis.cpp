#include "scenes/charts/time_axis.hpp"

#include <array>
#include <cmath>

#include "scenes/charts/clock_names.hpp"

namespace diurna {

namespace {

constexpr double axis_day = 86400.0;

/// [s] between marks of so many seconds: at most 13, whole days of long spans.
double step_of(double seconds) {
    constexpr std::array minutes = {1.0,  2.0,   5.0,   10.0,  15.0,  30.0,
                                    60.0, 120.0, 180.0, 360.0, 720.0, 1440.0};
    for (const double each : minutes) {
        if (seconds <= 12.0 * 60.0 * each) return 60.0 * each;
    }
    return axis_day * std::ceil(seconds / (12.0 * axis_day));
}

}  // namespace

std::string TimeAxis::says(Instant when) const {
    return (days() ? clock_day(when, utc_offset) + " " : "") +
           clock_time(later(when, 30.0), utc_offset).substr(0, 5);
}

TimeAxis time_axis(Instant start, Instant end, double utc_offset) {
    const double seconds = seconds_between(start, end);
    TimeAxis axis{.start = start,
                  .hours = seconds / 3600.0,
                  .utc_offset = utc_offset,
                  .title = "scene's clock, " + clock_zone(utc_offset) + ", from " +
                           clock_day(start, utc_offset)};
    const double step = step_of(seconds);
    const double clock = std::fmod(seconds_between(Instant{}, start) + utc_offset,
                                   std::max(step, axis_day));  // since midnight
    for (double at = step * std::ceil(clock / step) - clock; at <= seconds + 0.5; at += step) {
        const Instant when = later(start, at);
        const std::string time = clock_time(when, utc_offset);
        const bool date = axis.days() && time == "00:00";
        axis.ticks.emplace_back(at / 3600.0, date ? clock_day(when, utc_offset) : time);
    }
    return axis;
}

}  // namespace diurna
