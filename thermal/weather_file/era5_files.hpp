#pragma once

#include <filesystem>

#include "thermal/weather_file/era5.hpp"

namespace diurna {

/// A file of ERA5: CSV, netCDF, or the store's zip archive, whose members (the instantaneous and
/// the accumulated variables) are joined.
Era5Series read_era5_series(const std::filesystem::path& file);

}  // namespace diurna
