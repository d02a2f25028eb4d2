#pragma once

#include <filesystem>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// EnergyPlus weather (EnergyPlus Auxiliary Programs, "EPW Data Dictionary").
///
/// Eight lines of header, then one an hour in local standard time: hour h ends at h o'clock, or at
/// minute m of it where the hour has several. Radiation and rain are of that interval, temperature,
/// humidity, pressure, wind and cloud of its end. A value at or above its code for missing is
/// missing; an opaque sky cover counts before the total one. Wind at 10 m, air at 2 m (WMO).
WeatherTable read_epw(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
