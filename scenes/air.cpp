#include "scenes/air.hpp"

#include <algorithm>
#include <cmath>

#include "materials/scattering.hpp"
#include "terrain/parallel.hpp"
#include "terrain/sun.hpp"
#include "thermal/irradiance.hpp"

namespace diurna {

namespace {

Stamp stamp_of(const std::string& interval) {
    return interval == "start" ? Stamp::start : interval == "end" ? Stamp::end : Stamp::instant;
}

/// The series at every step of the heat balance, its unmeasured radiation from the atmosphere.
Weather driven_by_air(const Scene& scene, const World& world, const Weather& weather) {
    Weather driven = weather;
    driven.note = "sun and longwave that were not measured come from the scene's atmosphere";
    const auto steps = static_cast<std::size_t>(std::lround(scene.time.duration / scene.time.step));
    driven.instant.resize(steps + 1);
    driven.sample.resize(steps + 1);
    const double ground_km = world.sea_level_height / 1000.0;
    const auto fill = [&](std::size_t i) {
        const Instant instant = later(scene.time.start, static_cast<double>(i) * scene.time.step);
        const SunPosition sun = sun_position(world.site, instant);
        const GroundFluxes flux = ground_fluxes(
            atmosphere_at(scene, world, weather, instant),
            {.zenith_deg = 90.0 - sun.elevation_deg, .distance_au = sun.distance_au}, ground_km);
        Forcing forcing = weather.at(instant);
        if (std::isnan(forcing.shortwave_down) && std::isnan(forcing.direct_normal)) {
            forcing.direct_normal = flux.sun_direct;
            forcing.diffuse = flux.sun_diffuse;
        }
        if (std::isnan(forcing.longwave_down)) forcing.longwave_down = flux.thermal;
        driven.instant[i] = instant;
        driven.sample[i] = forcing;
    };
    for_each_index(steps + 1, fill, 4);
    return driven;
}

}  // namespace

Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant) {
    const AirInput& air = scene.air;
    if (air.vacuum) return Vacuum{};
    const Forcing forcing = weather.at(instant);
    const double ground_km = world.sea_level_height / 1000.0;
    BandModel model;
    model.profile = with_surface(afgl_profile(air.profile), ground_km, forcing.air.temperature,
                                 forcing.air.vapour_pressure / 100.0);
    model.aerosol = air.aerosol;
    model.visibility_km = air.visibility_km;
    model.co2_ppm = air.co2_ppm;
    model.ground_km = std::max(0.0, ground_km);
    model.rain_mm_h = forcing.rain_mm_h;
    if (!std::isnan(forcing.cloud_fraction)) model.cloud.fraction = forcing.cloud_fraction;
    model.cloud.base_km = ground_km + air.cloud_base_km;
    return model;
}

Weather scene_weather(const Scene& scene, const World& world) {
    Weather weather =
        read_weather(scene.weather.file, {.interval = stamp_of(scene.weather.interval),
                                          .wind_height = scene.weather.wind_height,
                                          .air_height = scene.weather.air_height,
                                          .elevation = world.sea_level_height});
    infer_cloud(weather, world.site, world.sea_level_height);
    return scene.air.drives_heat ? driven_by_air(scene, world, weather) : weather;
}

}  // namespace diurna
