#pragma once

#include <optional>

#include "terrain/place/site.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The place that a file's weather is used for.
struct WeatherPlace {
    std::optional<Site> site;
    double elevation = 0.0;     // [m] above the sea
    bool height_named = false;  // the user has given the height of the measurement
    bool carried = false;       // air and sky are converted to the place's height
};

/// Adds warnings if the station is more than 50 km (on a sphere of 6371 km) or 200 m of height from
/// the place: its climate differs. None if the file names no place.
void warn_of_place(WeatherTable& table, const WeatherPlace& place);

/// Great-circle distance of two places [km].
double distance_km(const Geodetic& a, const Geodetic& b);

}  // namespace diurna
