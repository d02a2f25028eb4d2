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

/// Recognises a file by its first lines, and by its extension where that promises a format; a zip
/// archive by the weather file in it. Throws InputError where the two contradict each other.
WeatherFormat weather_format(const std::filesystem::path& file);

/// Whether a zip archive is one that the Climate Data Store gives: it holds netCDF files, or CSV of
/// ERA5. False for what is no zip archive.
bool is_era5_zip(const std::filesystem::path& file);
/// Whether it is that, or has one weather file as text in it (weather_text.hpp), as EPW and NSRDB
/// are given out.
bool is_weather_zip(const std::filesystem::path& file);

}  // namespace diurna
