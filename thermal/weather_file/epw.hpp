#pragma once

#include <filesystem>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// EnergyPlus weather (EnergyPlus Auxiliary Programs, "EPW Data Dictionary").
///
/// Eight lines of header, then rows in local standard time: hour h ends at h o'clock; several rows
/// per hour divide it in their order (epw_times.hpp). Radiation and rain are those of the interval,
/// temperature, humidity, pressure, wind and cloud those at its end. If a comment names an
/// irradiance time offset (PVGIS), radiation is that at the instant offset from the row's end. A
/// value at or above its code for missing is missing, and so are infrared and pressure of 0; opaque
/// sky cover counts before the total one. Wind at 10 m, air at 2 m (WMO).
WeatherTable read_epw(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
