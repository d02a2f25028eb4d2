#pragma once

#include <string>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

/// Instants as text for readers of a page: on the scene's clock, `utc_offset` [s] ahead of UTC.
namespace diurna {

/// "05:12", with seconds where they are not zero.
std::string clock_time(Instant instant, double utc_offset);

/// "15 July".
std::string clock_day(Instant instant, double utc_offset);

/// "UTC−04:00".
std::string clock_zone(double utc_offset);

}  // namespace diurna
