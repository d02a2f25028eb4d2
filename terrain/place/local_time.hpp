#pragma once

#include <string>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// "2026-07-15T05:00:00-04:00": an instant on a clock with this offset from UTC [s].
std::string format_local(Instant instant, double utc_offset);

/// Hours of apparent solar time, 0 to 24: 12 is when the sun crosses the site's meridian in the
/// south or north (by the hour angle of terrain/place/sun.hpp, 0.1 s).
double solar_time_h(const Site& site, Instant instant);
/// "05:12": the same to the minute.
std::string format_solar_time(const Site& site, Instant instant);

}  // namespace diurna
