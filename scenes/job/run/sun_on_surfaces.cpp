#include "scenes/job/run/sun_on_surfaces.hpp"

#include <algorithm>
#include <cstdint>

#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

SunPosition sun_over(const Prepared& prepared, Instant instant) {
    const World& world = prepared.world;
    return apparent_sun(world.site, world.sea_level_height, prepared.weather, instant);
}

std::vector<float> sun_on_surfaces(const Prepared& prepared, const SunPosition& sun, int samples,
                                   std::span<const SurfaceId> wanted, float time) {
    if (!(sun.elevation_deg > 0.0)) return {};
    const World& world = prepared.world;
    const TextureLevels& levels = world.texture_levels;
    std::vector<float> fraction(world.facets.size(), 0.0f);
    const SunFractionOptions options{.samples = samples,
                                     .edge_samples = edge_samples(samples),
                                     .seed = prepared.scene.seed,
                                     .time = time};
    if (wanted.empty()) {
        sun_fraction(world.facets, prepared.rays, sun_direction(sun), fraction, options);
    } else {
        std::vector<std::uint32_t> chosen;
        for (const SurfaceId surface : wanted) {
            chosen.push_back(static_cast<std::uint32_t>(levels.facet_of(surface)));
        }
        std::sort(chosen.begin(), chosen.end());
        chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
        sun_fraction(world.facets, prepared.rays, sun_direction(sun), chosen, fraction, options);
    }
    if (levels.empty()) return fraction;
    return for_all_levels(levels, fraction);
}

}  // namespace diurna
