#pragma once

#include "materials/air/moist_air.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The apparent sun: raised by the refraction of the air at the ground. Used for sunlight, shadows
/// and pictures, so that they agree at sunrise and sunset.
///
/// - elevation: of the ground above the sea [m]: gives the standard pressure if that of the air
///   is
///   not known (0)
SunPosition apparent_sun(const SunPosition& geometric, const AirState& air, double elevation);

/// The same at an instant of a series of weather.
SunPosition apparent_sun(const Site& site, double elevation, const Weather& weather, Instant when);

}  // namespace diurna
