#pragma once

#include <filesystem>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// ERA5 at a point as netCDF: variables by short names (thermal/weather_file/era5.hpp) over
/// valid_time or time and dimensions of length one; packed values (scale_factor, add_offset,
/// _FillValue) as in older files. Throws InputError for more than one place.
WeatherTable read_era5_netcdf(const std::filesystem::path& file);

}  // namespace diurna
