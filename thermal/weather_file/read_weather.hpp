#pragma once

#include <filesystem>
#include <span>

#include "thermal/weather/weather.hpp"
#include "thermal/weather_file/weather_files.hpp"
#include "thermal/weather_file/weather_format.hpp"
#include "thermal/weather_file/weather_options.hpp"

namespace diurna {

/// Reads a weather file of any format: detects the format, fills gaps, computes the series.
///
/// The requested span must be within the file's. One usual interval (a day at most) is allowed
/// beyond either end, where the last row is held; the note says so. Throws InputError with the
/// file's span and the requested one, with file:line:column for values that are no number or out of
/// range and rows that do not ascend, and if `interval` contradicts the format.
Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options = {});
/// The same for several files of one format, joined (weather_files.hpp).
Weather read_weather(std::span<const std::filesystem::path> files,
                     const WeatherOptions& options = {});

}  // namespace diurna
