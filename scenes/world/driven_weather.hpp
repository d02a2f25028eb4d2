#pragma once

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

/// A scene's weather with the sunlight and longwave of the scene's air where nobody measured them:
/// clear light by air_light.hpp, under cloud sunlight by Kasten & Czeplak
/// (materials/atmosphere/cloud_modification.hpp) and longwave of a black base behind the air below.
///
/// Where all is measured: as it is. Where only longwave is missing it is put into the rows.
/// Otherwise the series is a new one with every step of the heat balance. Rows whose cloud nobody
/// saw nor measured sunlight shows are cloudless.
Weather driven_weather(const Scene& scene, const World& world, const SkySeries& series);

}  // namespace diurna
