#pragma once

#include <memory>

#include "materials/air/profile.hpp"
#include "scenes/input/scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The profile of a scene's air, before the weather of an instant replaces its lowest part: the
/// sounding, the named AFGL profile, or Weather::above.
std::shared_ptr<const Profile> upper_air(const Scene& scene, const Weather& weather);

/// Sets Weather::above: the seasonal profile for the mean temperature at the station's height from
/// one instant to another, at least a day. Null, and no note, if the scene has its own.
void take_upper_air(const Scene& scene, Instant from, Instant to, Weather& weather);

}  // namespace diurna
