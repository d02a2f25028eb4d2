#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Content of a first scene: names of files beside it, and what they contain.
struct FirstScene {
    std::string name;
    std::string elevation, weather;  // files in its folder
    bool weather_made_up = false;    // the file is clear_day(), not a measurement
    bool fills_voids = false;        // the raster has posts without elevation
    Geodetic place;                  // of its middle
    double radius = 1000.0;          // [m] of the ground
    Instant start;
    double duration_h = 24.0;
    double utc_offset = 0.0;             // [s] of its clock ahead of UTC
    std::vector<std::string> columns{};  // lines of [weather.columns]
    std::string date_note{};  // why it has another date than the usual one; "": it has not
};

/// A scene file with a comment at each part: ground, a lorry and a generator, a camera each
/// hour.
std::string first_scene_text(const FirstScene& scene);

/// Three clear days around `day`, as CSV: air linear between 288 K at 5 and 302 K at 15 h of local
/// mean solar time, vapour at half of saturation at 15 h, wind of 2 m/s. Not a measurement; the
/// file says so.
///
/// - day: midnight of the middle day
/// - utc_offset: [s] of the clock
std::string clear_day(Instant day, double utc_offset);

}  // namespace diurna
