#pragma once

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The weather file as it is read.
Weather measured_weather(const Scene& scene, const World& world);
/// The weather of a scene: what was measured, and sunlight and longwave that were not from the
/// scene's air (driven_weather.hpp); with `[atmosphere] drives_heat = false` those stay open, for
/// the broadband formulas of thermal/weather/sky_state.hpp.
Weather scene_weather(const Scene& scene, const World& world);
Weather scene_weather(const Scene& scene, const World& world, Weather measured);

}  // namespace diurna
