#include "scenes/job/world/air.hpp"
#include "scenes/job/world/scene_weather.hpp"

#include <catch2/catch.hpp>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather/sky_state.hpp"

using namespace diurna;

namespace {

struct Read {
    Scene scene;
    World world;
};

Read read(const std::string& text) {
    const ScratchFolder folder("scene-air");
    write_text(folder.path / "scene.toml", text);
    Scene scene = read_scene(folder.path / "scene.toml");
    World world;
    world.site = {36.32, -84.203333, 323.0};
    world.sea_level_height = 323.0;
    return {std::move(scene), std::move(world)};
}

}  // namespace

TEST_CASE("the air in the picture has the weather's temperature and humidity at the ground",
          "[scenes][air]") {
    const Read r = read(small_scene());
    const Weather weather = scene_weather(r.scene, r.world);
    for (const double hour : {5.0, 15.0}) {
        const Instant instant = later(r.scene.time.start, 3600.0 * hour);
        const Atmosphere atmosphere = atmosphere_at(r.scene, r.world, weather, instant);
        const AirSample air = air_at(std::get<BandModel>(atmosphere).profile, 0.323);
        CHECK(air.temperature == Approx(weather.at(instant).air.temperature).margin(0.01));
    }
}

TEST_CASE(
    "what nobody measured of sun and sky comes from the scene's air, or from formulas of the "
    "same haze",
    "[scenes][air]") {
    const Read plain = read(small_scene() + "[atmosphere]\ndrives_heat = false\n");
    const Read driven = read(small_scene());
    const Weather formulas = scene_weather(plain.scene, plain.world);
    const Weather air = scene_weather(driven.scene, driven.world);
    CHECK(air.instant.size() == 24 * 3 + 1);
    const Instant noon = later(plain.scene.time.start, 13.5 * 3600.0);
    const SkyState bird =
        sky_state(plain.world.site, 323.0, noon, formulas.at(noon), plain.scene.sky);
    const Forcing found = air.at(noon);
    // Bird's formula with the depth of 23 km of rural haze is within 10 % of multiple scattering in
    // its beam and 30 below in its diffuse light (libRadtran at 20 km: 636 to 634, 261 to 234).
    CHECK(found.direct_normal == Approx(bird.direct_normal).epsilon(0.1));
    CHECK(found.diffuse == Approx(bird.diffuse_horizontal).margin(50.0));
    CHECK(found.longwave_down == Approx(bird.longwave_down).epsilon(0.06));
    // At night there is no sun, and the longwave sky still follows the air.
    const Forcing night = air.at(plain.scene.time.start);
    CHECK(night.direct_normal == 0.0);
    CHECK(night.diffuse == 0.0);
    CHECK(night.longwave_down > 250.0);
}

TEST_CASE("haze takes from the heat balance what it takes from the picture's sun",
          "[scenes][air][light]") {
    // libRadtran has 636 W/m² of beam on the level at V = 20 km; through ten times less visibility
    // e^(−m (2.61 − 0.36)) of the visible part is left: little.
    const Read clear = read(small_scene());
    const Read hazy = read(small_scene() + "[atmosphere]\nvisibility_km = 2.0\n");
    const Instant noon = later(clear.scene.time.start, 13.5 * 3600.0);
    const Forcing here = scene_weather(clear.scene, clear.world).at(noon);
    const Forcing there = scene_weather(hazy.scene, hazy.world).at(noon);
    CHECK(there.direct_normal < 0.35 * here.direct_normal);
    CHECK(there.diffuse > 1.5 * here.diffuse);
}

TEST_CASE("the air of a picture sends what the heat balance receives, measured or not",
          "[scenes][air][light]") {
    const std::string keys =
        GENERATE("", "[atmosphere]\ndrives_heat = false\n", "[atmosphere]\nvisibility_km = 4.0\n");
    const Read r = read(small_scene() + keys);
    Weather weather = scene_weather(r.scene, r.world);
    const bool measured = GENERATE(false, true);
    for (Forcing& f : weather.sample) {
        if (!measured) break;
        f.direct_normal = 300.0;
        f.diffuse = 250.0;
        f.longwave_down = 390.0;
    }
    weather.span.clear();
    const SkySeries sky(weather, r.world.site, weather.height, r.scene.sky, r.scene.time.start,
                        r.scene.time.end());
    for (const double hour : {2.0, 9.0, 13.5, 17.0}) {
        const Instant when = later(r.scene.time.start, 3600.0 * hour);
        const SkyState heat = sky.at(when, sun_position(r.world.site, when));
        const LightOfInstant light = scene_light(r.scene, r.world, sky, when);
        const GroundFluxes found = ground_fluxes(
            light.air,
            {.zenith_deg = 90.0 - heat.sun.elevation_deg, .distance_au = heat.sun.distance_au},
            0.323);
        CAPTURE(keys, measured, hour);
        if (heat.sun.elevation_deg > 0.0) {
            CHECK(found.sun_direct == Approx(heat.direct_normal).epsilon(2e-3).margin(0.05));
            CHECK(found.sun_diffuse == Approx(heat.diffuse_horizontal).epsilon(2e-3).margin(0.05));
        }
        CHECK(found.thermal == Approx(heat.longwave_down).margin(0.2));
        CHECK(light.sums.thermal == Approx(found.thermal).margin(1e-6));
    }
}

TEST_CASE("a vacuum drives no heat balance", "[scenes][air][by_degenerate]") {
    const ScratchFolder folder("scene-air");
    write_text(folder.path / "scene.toml",
               small_scene() + "[atmosphere]\nprofile = \"vacuum\"\ndrives_heat = true\n");
    CHECK_THROWS_AS(read_scene(folder.path / "scene.toml"), InputError);
}
