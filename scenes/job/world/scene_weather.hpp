#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The weather file as read.
Weather measured_weather(const Scene& scene, const World& world);
/// The weather of a scene: measured values, and unmeasured sunlight and longwave from the scene's
/// air (driven_weather.hpp); with `[atmosphere] drives_heat = false` these stay unmeasured, for the
/// broadband formulas of thermal/weather/sky_state.hpp.
Weather scene_weather(const Scene& scene, const World& world);
Weather scene_weather(const Scene& scene, const World& world, Weather measured);

}  // namespace diurna
