#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// What a first scene is made of: names of files beside it, and what was found in them.
struct FirstScene {
    std::string name;
    std::string elevation, weather;  // files in its folder
    bool weather_made_up = false;    // the file is clear_day(), no measurement
    bool fills_voids = false;        // the raster has posts without elevation
    Geodetic place;                  // of its middle
    double radius = 1000.0;          // [m] of the ground
    Instant start;
    double duration_h = 24.0;
    double utc_offset = 0.0;  // [s] of the clock it is given by
};

/// A scene file with a comment beside each part: ground, a lorry and a generator, a camera each
/// hour.
std::string first_scene_text(const FirstScene& scene);

/// Three clear days about one, as CSV: air straight between 288 K at 5 and 302 K at 15 h of local
/// mean solar time, half of its vapour at 15 h, wind of 2 m/s. Nobody's measurement; the file says
/// so.
///
/// - day: midnight of the one in the middle
/// - utc_offset: [s] of the clock
std::string clear_day(Instant day, double utc_offset);

}  // namespace diurna
