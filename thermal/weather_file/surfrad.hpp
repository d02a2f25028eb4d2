#pragma once

#include <filesystem>
#include <string_view>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A day of a SURFRAD station (NOAA GML, README_SURFRAD.txt): two lines of station, its longitude
/// counted west, then one line a minute (three before 2009), UTC, stamped with the end of the mean.
///
/// Each value has a flag: 1 is bad and treated as missing, like -9999.9; 2, questionable, is used.
/// Both are counted in the notes. Wind and air at 10 m. One file may hold several days in sequence,
/// each with its two header lines.
WeatherTable read_surfrad(const std::filesystem::path& file);

/// Whether a line is a station's place: "  37.70  105.92 2317 m version 1".
bool is_surfrad_place(std::string_view line);

}  // namespace diurna
