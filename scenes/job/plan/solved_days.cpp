#include "scenes/job/plan/solved_days.hpp"

#include <algorithm>

#include "scenes/job/plan/plan_costs.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/solve/solve_span.hpp"
#include "thermal/weather/repeated_day.hpp"

namespace diurna {

namespace {

/// Of the day from an instant, the part with the sun up.
double sunlit_share(const Site& site, Instant start) {
    constexpr int looks = 96;
    int up = 0;
    for (int i = 0; i < looks; ++i) {
        const Instant when = later(start, seconds_of_day * i / looks);
        up += sun_is_up(site, when);
    }
    return double(up) / looks;
}

}  // namespace

bool sun_is_up(const Site& site, Instant when) {
    return sun_position(site, when).elevation_deg > -0.84;
}

SolvedDays solved_days(const Scene& scene, const Site& site, const Weather& weather, bool moves) {
    const TimeInput& time = scene.time;
    const double span = time.duration / seconds_of_day;
    const int known = weather.instant.empty() ? 0 : days_known_before(weather, time.start);
    SolvedDays days{.repeated = 1.0, .more = span};
    if (time.spin_up == SpanStart::state || time.spin_up == SpanStart::steady) {
        days.repeated = 0.0;
    } else if (time.spin_up != SpanStart::periodic && known >= 1) {
        days.leads_in = true;
        // Without a trend the day before is not gone through again once it repeats.
        const int before = std::min(known, time.days_before);
        const bool again = has_trend(weather, later(time.start, -seconds_of_day * before));
        days.more += again ? before : before - 1;
    } else if (!moves && (weather.instant.empty() || repeats(weather, time.start))) {
        days.more = std::max(0.0, span - 1.0);
    }
    days.steps_of_day = seconds_of_day / time.step + 1.0;
    const double first = std::max(days.repeated, std::min(1.0, days.more));
    days.days = first + plan_costs.heat_day_more * (days.more - (first - days.repeated));
    days.steps = days.steps_of_day * days.days;
    days.sunlit = days.steps * sunlit_share(site, time.start);
    return days;
}

}  // namespace diurna
