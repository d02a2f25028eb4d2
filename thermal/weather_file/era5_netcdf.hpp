#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "thermal/weather_file/era5.hpp"

namespace diurna {

/// ERA5 at a point as netCDF: variables by short names (thermal/weather_file/era5.hpp) over
/// valid_time or time and dimensions of length one; packed values (scale_factor, add_offset,
/// _FillValue) as in older files. Along a dimension expver (1 final, 5 preliminary) the first value
/// that is there counts. Throws InputError for more than one place.
Era5Series read_era5_netcdf(const std::filesystem::path& file);
/// The same of bytes that are at hand; `file` names them.
Era5Series era5_netcdf_series(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace diurna
