#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"
#include "thermal/weather_file/changed_weather.hpp"
#include "thermal/weather_file/gaps.hpp"
#include "thermal/weather_file/own_csv.hpp"
#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

struct WeatherOptions {
    /// What a time stamp means; none: as the format has it, or of CSV the end of an interval.
    std::optional<Stamp> interval{};
    std::optional<double> wind_height{};  // [m]; none: the format's, else 10
    std::optional<double> air_height{};   // [m]; none: the format's, else 2
    double elevation = 0.0;               // [m] above the sea, of the place it is to stand for
    /// [m] above the sea, of the ground below the instruments; none: what the file says of its
    /// station if `at_station`, else `elevation`. Pressure that the file lacks is that height's.
    std::optional<double> height{};
    bool at_station = false;
    std::vector<DeclaredColumn> columns{};
    OnGap on_gap = OnGap::refuse;
    WeatherChange change{};
    AskedSpan asked{};           // what must be covered; none: nothing in particular
    std::optional<Site> site{};  // tells night from day, and whether the station is far away
    std::string where = "weather.interval";  // of `interval`: "scene.toml:12:1: weather.interval"
    std::string where_changed = "weather.changed";
};

enum class WeatherFormat { csv, epw, tmy3, surfrad, bsrn, era5_csv, era5_netcdf };

/// Recognises a file by its first lines, and by its extension where that promises a format. Throws
/// InputError where the two contradict each other.
WeatherFormat weather_format(const std::filesystem::path& file);

/// A file of any format as it stands: its rows in SI, gaps as they are, nothing filled or changed.
/// Of the options `asked` (the year that a typical one stands for) and `columns` count. Throws
/// InputError as read_weather does of what it reads.
WeatherTable read_weather_table(const std::filesystem::path& file, const WeatherOptions& options);

/// Reads a weather file of any format: recognise it, fill its gaps, place its rows.
///
/// The asked span must lie within what the file covers. One usual interval (a day at most) is
/// allowed beyond either end, where the last row is held; the note says so. Throws InputError with
/// the file's span and what was asked, with file:line:column for values that are no number or out
/// of range and rows that do not ascend, and where `interval` contradicts the format.
Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options = {});

}  // namespace diurna
