#pragma once

#include "thermal/weather/weather.hpp"

namespace diurna {

inline constexpr double seconds_of_day = 86400.0;

/// A series whose first day from `start` can be repeated: the change of its air and sky from end to
/// end is removed evenly, so that it ends as it began. The change due to a weather front belongs to
/// that day and not to earlier ones.
Weather without_trend(Weather weather, Instant start);

/// Whether without_trend() changes anything: more than 1e-6 K, Pa or W/m² from end to end.
bool has_trend(const Weather& weather, Instant start);

/// Whether the day from `start` ends as it began: air within 0.2 K and 20 Pa of vapour, wind within
/// 0.2 m/s, longwave within 2 W/m². Such a day can be repeated.
bool repeats(const Weather& weather, Instant start);

}  // namespace diurna
