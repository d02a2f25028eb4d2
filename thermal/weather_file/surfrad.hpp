#pragma once

#include <filesystem>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A day of a SURFRAD station (NOAA GML, README_SURFRAD.txt): two lines of station, its longitude
/// counted west, then one a minute (three before 2009), UTC, stamped with the end of the mean.
///
/// Each value has a flag: 1 is bad and taken as missing, as -9999.9 is; 2, questionable, is used.
/// Both are counted in the notes. Wind and air at 10 m.
WeatherTable read_surfrad(const std::filesystem::path& file);

}  // namespace diurna
