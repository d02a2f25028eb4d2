#pragma once

#include "materials/atmosphere.hpp"
#include "scenes/scene.hpp"
#include "scenes/world.hpp"
#include "thermal/weather.hpp"

namespace diurna {

/// The air between surface and eye at an instant: the scene's profile, made to have the weather's
/// temperature and humidity at the ground, with the weather's rain and cloud.
Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant);

/// The weather of a scene. With `[atmosphere] drives_heat = true`, direct, diffuse and longwave
/// radiation that nobody measured come from atmosphere_at() every `step` instead of the broadband
/// formulas of thermal/irradiance.hpp, so that solver and camera look through the same air.
Weather scene_weather(const Scene& scene, const World& world);

}  // namespace diurna
