#include "scenes/world/air.hpp"

#include <catch2/catch.hpp>

#include "scenes/input/scene_file.hpp"
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

TEST_CASE("an atmosphere that drives the heat balance stands in for what nobody measured",
          "[scenes][air]") {
    const Read plain = read(small_scene());
    const Read driven = read(small_scene() + "[atmosphere]\ndrives_heat = true\n");
    const Weather formulas = scene_weather(plain.scene, plain.world);
    const Weather air = scene_weather(driven.scene, driven.world);
    CHECK(air.instant.size() == 24 * 3 + 1);
    const Instant noon = later(plain.scene.time.start, 13.5 * 3600.0);
    const SkyState bird = sky_state(plain.world.site, 323.0, noon, formulas.at(noon));
    const Forcing found = air.at(noon);
    // Two models of one sky: Bird's guess of aerosol is not the profile's 23 km of rural haze.
    CHECK(found.direct_normal == Approx(bird.direct_normal).epsilon(0.2));
    CHECK(found.diffuse > 50.0);
    CHECK(found.diffuse < 300.0);
    CHECK(found.longwave_down == Approx(bird.longwave_down).epsilon(0.06));
    // At night there is no sun, and the longwave sky still follows the air.
    const Forcing night = air.at(plain.scene.time.start);
    CHECK(night.direct_normal == 0.0);
    CHECK(night.diffuse == 0.0);
    CHECK(night.longwave_down > 250.0);
}

TEST_CASE("a vacuum drives no heat balance", "[scenes][air][by_degenerate]") {
    const ScratchFolder folder("scene-air");
    write_text(folder.path / "scene.toml",
               small_scene() + "[atmosphere]\nprofile = \"vacuum\"\ndrives_heat = true\n");
    CHECK_THROWS_AS(read_scene(folder.path / "scene.toml"), InputError);
}
