#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// Values by ERA5's short names, (row), NaN where missing, in ERA5's units: t2m and d2m [K], u10
/// and v10 [m s⁻¹], sp [Pa], tcc, and sums over the hour that ends at the stamp: ssrd, fdir and
/// strd [J m⁻²], tp [m].
using Era5Values = std::map<std::string, std::vector<double>>;

/// The short names that are read.
const std::vector<std::string>& era5_names();

/// Fills a table whose stamps are there. Sums are those of one hour whatever lies between the rows
/// (ECMWF, ERA5 data documentation: "accumulations are over the hour ending at the validity
/// date/time"); fdir is the direct light on the horizontal, so the rest of ssrd is diffuse. A sum
/// since midnight, as ERA5-Land's own files hold, is refused. Wind at 10 m, air at 2 m.
void put_era5(const Era5Values& values, WeatherTable& table);

}  // namespace diurna
