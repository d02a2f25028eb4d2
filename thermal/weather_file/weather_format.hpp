#pragma once

#include <filesystem>

namespace diurna {

enum class WeatherFormat {
    csv,
    epw,
    tmy3,
    surfrad,
    bsrn,
    psm,
    solar_anywhere,
    pvgis,
    era5_csv,
    era5_netcdf,
    era5_zip
};

/// Detects a file's format by its first lines, and by its extension if that implies a format; for a
/// zip archive by the weather file in it. Throws InputError if the two contradict each other.
WeatherFormat weather_format(const std::filesystem::path& file);

/// Whether a zip archive is from the Climate Data Store: it holds netCDF files, or CSV of ERA5.
/// False for other files.
bool is_era5_zip(const std::filesystem::path& file);
/// Whether it is one, or holds one weather file as text (weather_text.hpp), as EPW and NSRDB are
/// distributed.
bool is_weather_zip(const std::filesystem::path& file);

}  // namespace diurna
