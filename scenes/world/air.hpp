#pragma once

#include <span>
#include "materials/atmosphere/atmosphere.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/world/heights.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The air at an instant: the scene's profile, made to have along the ground the air that the heat
/// balance has there (materials/air/air_by_height.hpp), with the weather's rain and cloud. Its
/// light is its own; scene_light() (scenes/world/instant_lights.hpp) has what the heat balance
/// receives.
Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant);
/// The same where it is known from where to where surfaces lie; and for given weather.
Atmosphere atmosphere_over(const Scene& scene, const World& world, const Weather& weather,
                           const HeightSpan& ground, Instant instant);
Atmosphere atmosphere_of(const Scene& scene, const World& world, const Weather& weather,
                         const HeightSpan& ground, const Forcing& forcing);

/// Throws InputError unless a table of paths holds the heights of the scene's surfaces and
/// observers and the lengths of its lines of sight. Scenes without one pass.
void check_table(const Scene& scene, const World& world, std::span<const Observer> observers);
/// What such a table leaves out, for the report.
std::vector<std::string> table_notes(const Scene& scene);

}  // namespace diurna
