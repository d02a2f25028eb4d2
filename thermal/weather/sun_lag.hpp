#pragma once

#include <optional>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Time difference between the course of measured sunlight and that of the sun.
struct SunLag {
    double seconds = 0.0;   // to be added to the weather's times; -12 h to 12 h
    double fit = 0.0;       // correlation with the clear sky's light after the shift
    double as_it_is = 0.0;  // and without a shift
};

/// Compares sunlight measured from `begin` to `end` with the clear sky of the place
/// (Haurwitz 1945: 1098 s exp(-0.057/s) W m⁻² of the sine s of the sun's elevation), by
/// their correlation at every shift, both as log(1 + E / 3 W m⁻²): so dawn and dusk,
/// which clouds do not shift, have most weight. A sample counts as the mean over its
/// interval.
///
/// Nothing if less than 20 h or fewer than 12 samples were measured, or without sun or
/// light.
/// there.
std::optional<SunLag> sun_lag(const Weather& weather, const Site& site, Instant begin, Instant end);

}  // namespace diurna
