#pragma once

#include <memory>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/sky_spread.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Distribution of the air's scattered sunlight over the sky, for the heat balance: from the same
/// light as pictures of the instant (instant_lights.hpp), in the functions used by pictures
/// (render/light/directional_sky.hpp), at eight wavelengths weighted by their diffuse light. For
/// hours of daylight, for long spans by height of the sun and share of the beam. Some 45 ms each.
/// Null if the air is a table or a vacuum, or the sun never rises.
///
/// - weather: as in the heat balance, with beam and diffuse light
std::shared_ptr<const SkySpreads> air_spread(const Scene& scene, const World& world,
                                             const Weather& weather);

}  // namespace diurna
