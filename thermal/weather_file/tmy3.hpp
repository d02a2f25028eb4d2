#pragma once

#include <filesystem>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// NREL's TMY3 (Wilcox & Marion 2008, NREL/TP-581-43156, tables 1-1 to 1-3), midnight written 24:00
/// or, as SolarAnywhere does, 00:00 of the next day.
///
/// A line for the station, a line of column names, then one an hour in local standard time.
/// Radiation and rain are of the hour that ends at the stamp, temperature, humidity,
/// pressure, wind and cloud of that instant. -9900 and below is missing. Wind at 10 m, air at
/// 2 m.
WeatherTable read_tmy3(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
