#pragma once

#include <optional>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// How far the course of measured sunlight is from the sun's.
struct SunLag {
    double seconds = 0.0;   // to be added to the weather's times; -12 h to 12 h
    double fit = 0.0;       // correlation with the clear sky's light, the times so shifted
    double as_it_is = 0.0;  // and unshifted
};

/// Sunlight that was measured from `begin` to `end` against the clear sky of the place (Haurwitz
/// 1945: 1098 s exp(-0.057/s) W m⁻² of the sine s of the sun's elevation), by their correlation at
/// every shift. Both are taken as log(1 + E / 3 W m⁻²): so dawn and dusk weigh most, which clouds
/// do not move, and a sample counts as the mean over its own interval.
///
/// Nothing where less than 20 h or fewer than 12 samples were measured, or no sun or no light was
/// there.
std::optional<SunLag> sun_lag(const Weather& weather, const Site& site, Instant begin, Instant end);

}  // namespace diurna
