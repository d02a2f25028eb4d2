#pragma once

#include <memory>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/light_by_height.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The light of a scene's air by height, hour by hour, where surfaces stand above the cloud's top
/// or haze is thicker than usual (a visibility below 23 km, fog) and heights differ by 50 m or
/// more. Null elsewhere, for a vacuum, a table and a station above the cloud: formulas hold there.
///
/// It is the light that pictures have (instant_lights.hpp), at the heights of ground and objects.
/// Spans of more than 200 hours: computed once for skies that are alike.
///
/// - weather: as the heat balance has it, without Weather::by_height
/// - measured: the same without what the scene's air was taken for
std::shared_ptr<const LightByHeight> light_at_heights(const Scene& scene, const World& world,
                                                      const Weather& weather,
                                                      const Weather& measured);

}  // namespace diurna
