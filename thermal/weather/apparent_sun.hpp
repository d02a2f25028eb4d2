#pragma once

#include "materials/air/moist_air.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The sun where it is seen: raised by the refraction of the air at the ground. One place for
/// sunlight, shadows and pictures, so that they rise and set together.
///
/// - elevation: of the ground above the sea [m]: the standard atmosphere's pressure where the air's
///   is not known (0)
SunPosition apparent_sun(const SunPosition& geometric, const AirState& air, double elevation);

/// The same at an instant of a series of weather.
SunPosition apparent_sun(const Site& site, double elevation, const Weather& weather, Instant when);

}  // namespace diurna
