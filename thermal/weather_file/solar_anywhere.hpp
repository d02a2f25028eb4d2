#pragma once

#include <filesystem>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// SolarAnywhere's files (Clean Power Research, "SA format"): a line of site as in TMY3 (number,
/// name, state, time zone, latitude, longitude, elevation, then remarks), a line of columns, rows.
///
/// ObservationTime(LST) or (GMT), "MM/DD/YYYY HH:MM", is the end of the interval of a row's mean.
/// Columns "Global Horizontal Irradiance (GHI) W/m2", "AmbientTemperature (deg C)" and so on;
/// clear-sky columns are models and not read. Empty cells and −999 and less are missing. If the
/// remarks name a typical year, the rows are valid for any year. Wind at 10 m, air at 2 m.
WeatherTable read_solar_anywhere(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
