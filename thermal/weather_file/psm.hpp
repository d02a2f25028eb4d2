#pragma once

#include <filesystem>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The National Solar Radiation Database's files (NREL, Physical Solar Model 3 and 4, also their
/// typical years), and SAM's CSV, which is similar.
///
/// Two lines of header: names ("Source,Location ID,...,Latitude,Longitude,Time Zone,Elevation,...",
/// then "... Units") and their values; a line of columns (Year, Month, Day, Hour, Minute, GHI, DNI,
/// DHI, Temperature, Dew Point, Relative Humidity, Pressure, Wind Speed, in any order, others are
/// skipped); rows, each for the instant that it names, in the header's time zone. Units are those
/// of the header, else W/m2, °C, %, mbar, m/s. −999 and less is missing. Wind at 10 m, air at 2 m.
/// Clear-sky columns are models and not read.
WeatherTable read_psm(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
