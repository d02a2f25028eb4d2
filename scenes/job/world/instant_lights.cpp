#include "scenes/job/world/instant_lights.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include "scenes/job/world/air.hpp"
#include "scenes/job/world/heights.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/apparent_sun.hpp"
#include "thermal/weather/sky_by_height.hpp"

namespace diurna {

namespace {

/// What the heat balance receives on level ground at the scene's origin.
SkyState sky_at_origin(const Scene& scene, const World& world, const SkySeries& sky,
                       Instant instant) {
    const SkyState station = sky.at(instant, sun_position(world.site, instant));
    const Weather& weather = sky.weather();
    constexpr double same = 0.5;  // [m]
    if (std::abs(weather.height - world.sea_level_height) < same) return station;
    const AirByHeight rule = air_by_height(scene, weather);
    const Forcing now = weather.at(instant);
    return sky_at_height(station, now, air_at_height(rule, now.air, world.sea_level_height), rule,
                         world.sea_level_height, scene.sky);
}

LightOfInstant light_over(const Scene& scene, const World& world, const SkySeries& sky,
                          const HeightSpan& ground, Instant instant) {
    const Weather& weather = sky.weather();
    const Atmosphere air = atmosphere_over(scene, world, weather, ground, instant);
    const SunPosition sun = apparent_sun(world.site, world.sea_level_height, weather, instant);
    const SunLight lit{.zenith_deg = 90.0 - sun.elevation_deg, .distance_au = sun.distance_au};
    const double ground_km = world.sea_level_height / 1000.0;
    const SkyState known = sky_at_origin(scene, world, sky, instant);
    if (const auto* model = std::get_if<BandModel>(&air)) {
        return light_of_instant(*model, lit, ground_km,
                                {.direct_normal = known.direct_normal,
                                 .diffuse = known.diffuse_horizontal,
                                 .longwave_down = known.longwave_down});
    }
    return {.air = air,
            .sums = {.sun_direct = known.direct_normal,
                     .sun_diffuse = known.diffuse_horizontal,
                     .thermal = known.longwave_down},
            .cloud_cover = 0.0};
}

}  // namespace

LightOfInstant scene_light(const Scene& scene, const World& world, const SkySeries& sky,
                           Instant instant) {
    return light_over(scene, world, sky, heights_of_ground(world), instant);
}

InstantLights::InstantLights(const Scene& scene, const World& world, const Weather& weather)
    : sky_(weather, world.site, weather.height, scene.sky, scene.time.start, scene.time.end()) {
    if (world.ground_facets > 0) ground_ = heights_of_ground(world);
}

LightOfInstant InstantLights::at(const Scene& scene, const World& world, Instant instant) const {
    const HeightSpan ground = ground_ ? *ground_ : heights_of_ground(world);
    const Key key{seconds_between(Instant{}, instant), ground.low, ground.high};
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = found_.find(key); known != found_.end()) return known->second;
    }
    LightOfInstant light = light_over(scene, world, sky_, ground, instant);
    const std::lock_guard lock(mutex_);
    return found_.emplace(key, std::move(light)).first->second;
}

}  // namespace diurna
