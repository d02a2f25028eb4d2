#pragma once

#include <string>
#include <vector>

#include "thermal/weather_file/era5_series.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The short names that are read.
const std::vector<std::string>& era5_names();

bool is_era5_name(const std::string& name);

/// Adds a row's stamp. Throws InputError(where) unless it comes after the one before.
void add_stamp(Era5Series& series, Instant stamp, const std::string& where);

/// Adds the rows and variables of another file: the store separates instantaneous from accumulated
/// variables, users download months separately. For a value in both the first is used. Throws
/// InputError for another place.
void join_era5(Era5Series& all, const Era5Series& more);

/// The table of a series. Sums are those of one hour for any interval between the rows (ECMWF, ERA5
/// data documentation: "accumulations are over the hour ending at the validity date/time"); fdir is
/// the direct light on the horizontal, so the rest of ssrd is diffuse. Sums since midnight, as in
/// ERA5-Land's own files, are converted (era5_sums.hpp). Wind at 10 m, air at 2 m.
WeatherTable era5_table(Era5Series series);

}  // namespace diurna
