#pragma once

#include <filesystem>
#include <span>

#include "thermal/weather_file/weather_options.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// A file of any format as it stands: its rows in SI, gaps as they are, nothing filled or changed.
/// Of the options `asked` (the year that a typical one stands for) and `columns` count. Throws
/// InputError as read_weather does of what it reads.
WeatherTable read_weather_table(const std::filesystem::path& file, const WeatherOptions& options);

/// Several files of one format as one table, whatever their order in the list: their rows in the
/// order of time. Of an instant that two files have, the value of the first in the list counts;
/// columns that one of them lacks are missing there. ERA5's may be of different variables
/// (era5.hpp). Throws InputError for files of different formats or stations.
WeatherTable read_weather_tables(std::span<const std::filesystem::path> files,
                                 const WeatherOptions& options);

}  // namespace diurna
