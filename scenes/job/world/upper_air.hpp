#pragma once

#include <memory>

#include "materials/air/profile.hpp"
#include "scenes/job/input/scene.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The profile of a scene's air, before the weather of an instant replaces its lowest part: the
/// sounding, the named AFGL profile, or Weather::above.
std::shared_ptr<const Profile> upper_air(const Scene& scene, const Weather& weather);

/// Weather::above: the profile of the season by the mean temperature at the station's height over
/// the days of local mean solar time that the scene's span touches, so that parts of a day have
/// the air of the whole. Null, and no note, where the scene has its own.
void take_upper_air(const Scene& scene, double longitude_deg, Weather& weather);

}  // namespace diurna
