#pragma once

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

/// A scene's weather, with unmeasured sunlight and longwave from the scene's air: clear light by
/// air_light.hpp, under cloud sunlight by Kasten & Czeplak
/// (materials/atmosphere/cloud_modification.hpp) and longwave of a black cloud base with air below
/// it.
///
/// Unchanged if everything is measured. If only longwave is missing it is added to the rows.
/// Otherwise the series has every step of the heat balance. Rows whose cloud was neither observed
/// nor can be inferred from measured sunlight are cloudless.
Weather driven_weather(const Scene& scene, const World& world, const SkySeries& series);

}  // namespace diurna
