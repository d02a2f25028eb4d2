#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "terrain/place/site.hpp"
#include "thermal/weather_file/era5.hpp"

namespace diurna {

/// ERA5 at a point as netCDF: variables by short names (thermal/weather_file/era5.hpp) over
/// valid_time or time and dimensions of length one; packed values (scale_factor, add_offset,
/// _FillValue) as in older files. Along a dimension expver (1 final, 5 preliminary) the first value
/// present is used.
///
/// In an area, variables over latitude and longitude, the grid point nearest to the site that has
/// values is used (over the sea ERA5-Land has none); without a site the one nearest to the area's
/// middle. A note names it. Throws InputError for other dimensions longer than one.
Era5Series read_era5_netcdf(const std::filesystem::path& file,
                            const std::optional<Geodetic>& site = {});
/// The same for bytes in memory; `file` names them.
Era5Series era5_netcdf_series(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const std::optional<Geodetic>& site = {});

}  // namespace diurna
