#pragma once

#include "materials/base/section.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The keys of [weather] in scene and column files but its file: what a time stamp means and where
/// wind and air were measured.
///
/// interval     where the file does not say
/// lowest_wind  [m] least height that wind may be measured at
WeatherOptions read_weather_options(const Section& section, Stamp interval, double lowest_wind);

}  // namespace diurna
