#pragma once

#include <filesystem>
#include <string_view>

#include "thermal/weather_file/era5.hpp"

namespace diurna {

/// ERA5 at a point as CSV, as written by the Climate Data Store's time-series service: valid_time
/// (UTC, "2022-01-01 00:00:00"), short names (thermal/weather_file/era5.hpp), latitude, longitude;
/// other columns are skipped. Throws InputError for more than one place.
Era5Series read_era5_csv(const std::filesystem::path& file);
/// The same for a text in memory; `file` names it.
Era5Series era5_csv_series(const std::filesystem::path& file, std::string_view text);

}  // namespace diurna
