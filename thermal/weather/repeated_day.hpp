#pragma once

#include "thermal/weather/weather.hpp"

namespace diurna {

inline constexpr double seconds_of_day = 86400.0;

/// A series whose first day from `start` may have gone before itself: what its air and sky gained
/// or lost from end to end is taken out evenly, so that it ends as it began. A front that came
/// through is weather of that day and none of the days before.
Weather without_trend(Weather weather, Instant start);

/// Whether the day from `start` ends as it began: air within 0.2 K and 20 Pa of vapour, wind within
/// 0.2 m/s, longwave within 2 W/m². Such a day may go on for ever.
bool repeats(const Weather& weather, Instant start);

}  // namespace diurna
