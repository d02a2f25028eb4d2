#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"
#include "thermal/weather_file/changed_weather.hpp"
#include "thermal/weather_file/gaps.hpp"
#include "thermal/weather_file/own_csv.hpp"
#include "thermal/weather_file/typical_year.hpp"

namespace diurna {

struct WeatherOptions {
    /// What a time stamp means; none: as in the format, or for CSV the end of an interval.
    std::optional<Stamp> interval{};
    std::optional<double> wind_height{};  // [m]; none: the format's, else 10
    std::optional<double> air_height{};   // [m]; none: the format's, else 2
    double elevation = 0.0;               // [m] above the sea, of the place it is used for
    /// [m] above the sea, of the ground below the instruments; none: the file's for its
    /// station if `at_station`, else `elevation`. Pressure missing in the file is that of this
    /// height.
    std::optional<double> height{};
    bool at_station = false;
    std::vector<DeclaredColumn> columns{};
    std::vector<double> missing{};  // for CSV: numbers that mark missing values
    int skip_lines = 0;             // for CSV: above the header
    OnGap on_gap = OnGap::refuse;
    WeatherChange change{};
    AskedSpan asked{};           // span that must be covered; none: no check
    std::optional<Site> site{};  // for night and day, and the station's distance
    std::string where_file = "weather.file";
    std::string where = "weather.interval";  // of `interval`: "scene.toml:12:1: weather.interval"
    std::string where_changed = "weather.changed";
    std::string where_missing = "weather.missing";
};

}  // namespace diurna
