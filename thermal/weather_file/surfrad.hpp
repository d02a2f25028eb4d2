#pragma once

#include <filesystem>
#include <string_view>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A day of a SURFRAD station (NOAA GML, README_SURFRAD.txt): two lines of station, its longitude
/// counted west, then one a minute (three before 2009), UTC, stamped with the end of the mean.
///
/// Each value has a flag: 1 is bad and taken as missing, as -9999.9 is; 2, questionable, is used.
/// Both are counted in the notes. Wind and air at 10 m.
/// Several days may follow each other in one file, each with its two lines of head.
WeatherTable read_surfrad(const std::filesystem::path& file);

/// Whether a line is a station's place: "  37.70  105.92 2317 m version 1".
bool is_surfrad_place(std::string_view line);

}  // namespace diurna
