#pragma once

#include <filesystem>
#include <string_view>

#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// Whether a text begins like PVGIS' CSV: "Latitude (decimal degrees): 45.000".
bool is_pvgis(std::string_view text);

/// PVGIS' CSV (JRC) of a typical year, or of hours from year to year.
///
/// A typical year: lines "Latitude (decimal degrees): ...", longitude,
/// elevation and the irradiance time offset, the months' years, a line of columns (time(UTC), T2m,
/// RH, G(h), Gb(n), Gd(h), IR(h), WS10m, WD10m, SP), rows, a legend.
///
/// "20180708:0500" is the instant of air, wind and pressure; radiation is that of the instant later
/// by the offset in hours. Wind at 10 m, air at 2 m.
///
/// A series of hours (seriescalc) has lines "Radiation database: ...", "Slope: 0 deg.", "Azimuth:
/// ..." and columns time, G(i) or Gb(i), Gd(i), Gr(i), H_sun, T2m, WS10m, Int, and P where a PV
/// system was calculated. All are values at that instant, UTC. G(i), or the sum of its three parts,
/// is the global irradiance and Gd(i) the diffuse. Throws InputError if they are for an inclined
/// plane or a tracking one.
WeatherTable read_pvgis(const std::filesystem::path& file, const AskedSpan& asked);

}  // namespace diurna
