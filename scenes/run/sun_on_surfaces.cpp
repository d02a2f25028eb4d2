#include "scenes/run/sun_on_surfaces.hpp"

#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

SunPosition sun_over(const Prepared& prepared, Instant instant) {
    const World& world = prepared.world;
    return apparent_sun(world.site, world.sea_level_height, prepared.weather, instant);
}

std::vector<float> sun_on_surfaces(const Prepared& prepared, const SunPosition& sun, int samples) {
    if (!(sun.elevation_deg > 0.0)) return {};
    const World& world = prepared.world;
    std::vector<float> fraction(world.facets.size());
    sun_fraction(world.facets, prepared.rays, sun_direction(sun), fraction,
                 {.samples = samples, .seed = prepared.scene.seed});
    if (world.texture_levels.empty()) return fraction;
    return for_all_levels(world.texture_levels, fraction);
}

}  // namespace diurna
