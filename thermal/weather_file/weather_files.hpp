#pragma once

#include <filesystem>
#include <span>

#include "thermal/weather_file/weather_options.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A file of any format, unprocessed: its rows in SI, with gaps. Of the options `asked` (for the
/// year of a typical one) and `columns` are used. Throws InputError as read_weather for what it
/// reads.
WeatherTable read_weather_table(const std::filesystem::path& file, const WeatherOptions& options);

/// Several files of one format as one table, in any order: their rows in the order of time. For an
/// instant in two files, the value of the first in the list is used; columns that one of them lacks
/// are missing there. ERA5 files may hold different variables (era5.hpp). Throws InputError for
/// files of different formats or stations.
WeatherTable read_weather_tables(std::span<const std::filesystem::path> files,
                                 const WeatherOptions& options);

}  // namespace diurna
