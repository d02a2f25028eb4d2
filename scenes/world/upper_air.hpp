#pragma once

#include <memory>

#include "materials/air/profile.hpp"
#include "scenes/input/scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The profile of a scene's air, before the weather of an instant replaces its lowest part: the
/// sounding, the AFGL profile that is named, or Weather::above.
std::shared_ptr<const Profile> upper_air(const Scene& scene, const Weather& weather);

/// Weather::above: the profile of the season by the mean temperature at the station's height from
/// one instant to another, a day at least. Null, and no note, where the scene has its own.
void take_upper_air(const Scene& scene, Instant from, Instant to, Weather& weather);

}  // namespace diurna
