#include "scenes/job/world/light_at_heights.hpp"

#include <catch2/catch.hpp>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "scenes/job/world/scene_weather.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather/sky_by_height.hpp"

using namespace diurna;

namespace {

constexpr double origin = 323.0, plateau = 1323.0;  // [m] above the sea

/// Ground from 323 to 1323 m under weather whose cloud is set.
struct Slope {
    Scene scene;
    World world;
    Weather weather;

    Slope(const std::string& air, double cloud) {
        const ScratchFolder folder("light-at-heights");
        write_text(folder.path / "scene.toml",
                   with(small_scene(), "step_s = 1200.0", "step_s = 3600.0\nduration_h = 1.0") +
                       "[atmosphere]\n" + air);
        scene = read_scene(folder.path / "scene.toml");
        scene.time.start = later(scene.time.start, 13.0 * 3600.0);
        world.site = {36.32, -84.203333, origin};
        world.sea_level_height = origin;
        world.facets.vertex = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, float(plateau - origin)}};
        Weather measured = measured_weather(scene, world);
        for (Forcing& f : measured.sample) f.cloud_fraction = cloud;
        weather = scene_weather(scene, world, std::move(measured));
    }

    SkyState heat(double height) const {
        const Instant when = later(scene.time.start, 1800.0);
        const SkySeries series(weather, world.site, weather.height, scene.sky, scene.time.start,
                               scene.time.end());
        const AirByHeight rule = air_by_height(scene, weather);
        const Forcing now = weather.at(when);
        return sky_at_height(series.at(when, sun_position(world.site, when)), now,
                             air_at_height(rule, now.air, height), rule, height, scene.sky);
    }
    GroundFluxes picture(double height) const {
        const SkyState sky = heat(height);
        const InstantLights lights(scene, world, weather);
        return ground_fluxes(
            lights.at(scene, world, later(scene.time.start, 1800.0)).air,
            {.zenith_deg = 90.0 - sky.sun.elevation_deg, .distance_au = sky.sun.distance_au},
            1e-3 * height);
    }
};

}  // namespace

TEST_CASE("ground above an overcast has the clear sky's light, in heat as in pictures",
          "[scenes][air][heights]") {
    const Slope overcast("cloud_base_km = 0.1\n", 1.0), clear("cloud_base_km = 0.1\n", 0.0);
    const SkyState high = overcast.heat(plateau);
    const GroundFluxes seen = overcast.picture(plateau), bare = clear.picture(plateau);
    // Nothing is above it: the same beam and longwave as without the cloud.
    CHECK(high.direct_normal == Approx(bare.sun_direct).epsilon(0.015));
    CHECK(high.longwave_down == Approx(bare.thermal).margin(3.0));
    CHECK(high.diffuse_horizontal == Approx(seen.sun_diffuse).epsilon(0.03));
    CHECK(high.longwave_down == Approx(seen.thermal).margin(1.0));
    // Below, Kasten and Czeplak's quarter of the clear sky's light is left.
    const SkyState low = overcast.heat(origin), open = clear.heat(origin);
    CHECK(low.global_horizontal() == Approx(0.25 * open.global_horizontal()).epsilon(0.02));
    CHECK(overcast.weather.by_height->cloud_top == Approx(origin + 400.0));
    CHECK_FALSE(clear.weather.by_height);
}

TEST_CASE("ground that rises out of fog has the light that pictures have there",
          "[scenes][air][heights]") {
    const Slope fog("aerosol = \"fog_radiative\"\nvisibility_km = 0.5\n", 0.0);
    for (const double height : {origin + 20.0, 700.0, plateau}) {
        const SkyState heat = fog.heat(height);
        const GroundFluxes picture = fog.picture(height);
        CAPTURE(height);
        // A beam that fog takes at the ground is known to 4 % there (air_light.hpp).
        CHECK(heat.direct_normal == Approx(picture.sun_direct).epsilon(0.06).margin(2.0));
        CHECK(heat.diffuse_horizontal == Approx(picture.sun_diffuse).epsilon(0.03).margin(2.0));
    }
    CHECK(fog.heat(plateau).global_horizontal() > 1.2 * fog.heat(origin).global_horizontal());
}
