#pragma once

#include <filesystem>
#include <string_view>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// Whether a text begins like PVGIS' CSV: "Latitude (decimal degrees): 45.000".
bool is_pvgis(std::string_view text);

/// A typical year of PVGIS (JRC) as CSV: lines "Latitude (decimal degrees): ...", longitude,
/// elevation and the irradiance time offset, the months' years, a line of columns (time(UTC), T2m,
/// RH, G(h), Gb(n), Gd(h), IR(h), WS10m, WD10m, SP), rows, a legend.
///
/// "20180708:0500" is the instant of air, wind and pressure; radiation is of the instant so many
/// hours later as the offset says. Wind at 10 m, air at 2 m.
WeatherTable read_pvgis(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
