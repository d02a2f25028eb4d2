#pragma once

#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Warnings of a weather's samples from `begin` to `end` that are implausible for the place, though
/// not a mistake of the file; each kind once, with its first sample.
///
/// - air: outside the records at the ground, 183.9 K (Vostok 1983) to 329.9 K (Furnace
///   Creek 1913); wind over 60 m/s; rain over 305 mm/h (Holt 1947; all from WMO's archive of
///   extremes); humidity below 3 % throughout; pressure under 0.85 or over 1.075 of the standard
///   atmosphere's at the station (WMO: at the sea 870 hPa in Tip 1979, 1083.8 at Agata 1968), or
///   its mean under 0.935 or over 1.05 of it: the station is at another height
/// - radiation: outside the physically possible limits of BSRN (Long & Dutton 2002): with the
///   sun's flux S at its distance and the sine s of its elevation, global 1.5 S s^1.2 + 100,
///   diffuse 0.95 S s^1.2 + 50, reflected 1.2 S s^1.2 + 50, direct S, longwave 40 to 700 W m⁻² and
///   0.4 σT⁴ to σT⁴ + 25 of the air's temperature
/// - light while the sun is more than 3 degrees down, no light at all under a high sun, and a
///   course of light that is more than 40 minutes off the sun's (sun_lag.hpp), within 5 days of the
///   middle
///
/// - light that contradicts itself (light_contradictions.hpp), where times are not uncertain
///
/// The weather's own warnings come first. The sun is that of its station, where the file names one
/// more than a degree from the site. Hints advise what the file's format allows.
///
/// where: "scene.toml: weather.file"
std::vector<Mistake> weather_warnings(const Weather& weather, const Site& place, Instant begin,
                                      Instant end, const std::string& where);

}  // namespace diurna
