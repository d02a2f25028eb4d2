#pragma once

#include <filesystem>
#include <optional>

#include "terrain/place/site.hpp"
#include "thermal/weather_file/era5.hpp"

namespace diurna {

/// A file of ERA5: CSV, netCDF, or the store's zip archive, whose members (the instantaneous and
/// the accumulated variables) are joined. From an area the point nearest to the site is used
/// (era5_netcdf.hpp).
Era5Series read_era5_series(const std::filesystem::path& file,
                            const std::optional<Geodetic>& site = {});

}  // namespace diurna
