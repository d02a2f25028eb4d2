#pragma once

#include <memory>

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/sky_spread.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// How the scene's air spreads its scattered sunlight over the sky, for the heat balance: of the
/// light that pictures of the instant have (instant_lights.hpp), by the functions that they take it
/// by (render/light/directional_sky.hpp), at eight wavelengths weighted by their diffuse light.
/// Hours of daylight, of long spans by height of the sun and share of the beam. Some 45 ms each.
/// Null where the air is a table or a vacuum, or the sun never rises.
///
/// - weather: as the heat balance has it, beam and diffuse light known
std::shared_ptr<const SkySpreads> air_spread(const Scene& scene, const World& world,
                                             const Weather& weather);

}  // namespace diurna
