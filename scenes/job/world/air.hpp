#pragma once

#include <span>
#include "materials/atmosphere/atmosphere.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The air at an instant: the scene's profile, adjusted along the ground to the air of the heat
/// balance (materials/air/air_by_height.hpp), with the weather's rain and cloud. Its light is
/// not scaled; scene_light() (scenes/job/world/instant_lights.hpp) has that received in the heat
/// balance.
Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant);
/// The same if the height range of surfaces is known; and for given weather.
Atmosphere atmosphere_over(const Scene& scene, const World& world, const Weather& weather,
                           const HeightSpan& ground, Instant instant);
Atmosphere atmosphere_of(const Scene& scene, const World& world, const Weather& weather,
                         const HeightSpan& ground, const Forcing& forcing);

/// Throws InputError unless a table of paths covers the heights of the scene's surfaces and
/// observers and the lengths of its lines of sight. Scenes without a table pass.
void check_table(const Scene& scene, const World& world, std::span<const Observer> observers);
/// Effects that such a table omits, for the report.
std::vector<std::string> table_notes(const Scene& scene);

}  // namespace diurna
