#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "thermal/weather_file/read_weather.hpp"

namespace diurna {

/// What `file` of [weather] is.
inline constexpr const char* weather_file_says =
    "EPW, TMY3, SURFRAD, BSRN or ERA5 (CSV, netCDF), recognised by content, or CSV with columns as "
    "in thermal/weather_file/README.md";

/// The keys of [weather] in scene and column files but its file: what a time stamp means, what its
/// columns are, where wind and air were measured, what is done about gaps.
///
/// lowest_wind  [m] least height that wind may be measured at
WeatherOptions read_weather_options(const Section& section, double lowest_wind);

/// `measured_over` of [weather]: the name of the material below the pyranometers; "" if it is not
/// told.
std::string read_measured_over(const Section& section, const std::vector<std::string>& materials);

}  // namespace diurna
