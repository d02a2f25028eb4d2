#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/scene_weather.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/world/air.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// Ground from 250 to 1450 m, the site at 323.
World hills_world() {
    World world;
    world.site = {36.32, -84.203333, 323.0};
    world.sea_level_height = 323.0;
    append_facets(world.facets,
                  std::vector<Eigen::Vector3d>{{0, 0, 0}, {300, 0, -73}, {0, 300, 1127}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}},
                  std::vector<MaterialId>{MaterialId{0}}, ObjectId{0});
    return world;
}

struct Read {
    ScratchFolder folder{"scene-heights"};
    Scene scene;
    World world = hills_world();
    Weather weather;

    explicit Read(const std::string& text, const std::string& sounding = "") {
        if (!sounding.empty()) write_text(folder.path / "sonde.csv", sounding);
        write_text(folder.path / "scene.toml", text);
        scene = read_scene(folder.path / "scene.toml");
        weather = scene_weather(scene, world);
    }
};

std::string with_weather(const std::string& keys) {
    return with(small_scene(), "interval = \"instant\"\n", "interval = \"instant\"\n" + keys);
}

std::string problem(const std::string& text) {
    try {
        const Read r(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const std::string inversion =
    "height_m,pressure_hPa,temperature_C,dew_point_C\n"
    "300,980,18,16\n500,957.5,24,15\n1500,853,16,9\n5500,510,-12,-20\n";

}  // namespace

TEST_CASE("the camera's air and the heat balance's are one at every height", "[scenes][heights]") {
    const std::string keys =
        GENERATE("", "lapse = -9.8\n", "lapse = \"profile\"\n", "height_m = 1200.0\n", "sounding");
    const Read r(keys == "sounding" ? small_scene() + "[atmosphere]\nsounding = \"sonde.csv\"\n"
                                    : with_weather(keys),
                 inversion);
    const AirByHeight rule = air_by_height(r.scene, r.weather);
    for (const double hour : {5.0, 15.0}) {
        const Instant instant = later(r.scene.time.start, 3600.0 * hour);
        const AirState station = r.weather.at(instant).air;
        const Atmosphere atmosphere = atmosphere_at(r.scene, r.world, r.weather, instant);
        const Profile& line = std::get<BandModel>(atmosphere).profile;
        for (const double height : {251.0, 323.0, 400.0, 777.0, 1200.0, 1449.0}) {
            CAPTURE(keys, hour, height);
            const AirState ground = air_at_height(rule, station, height);
            const AirSample air = air_at(line, height * 1e-3);
            CHECK(air.temperature == Approx(ground.temperature).margin(0.02));
            CHECK(air.pressure_hPa * 100.0 == Approx(ground.pressure).epsilon(2e-4));
            CHECK(air.vapour_pressure_hPa() * 100.0 ==
                  Approx(ground.vapour_pressure).epsilon(3e-3));
        }
    }
}

TEST_CASE("a sounding's inversion is the lapse where none is given", "[scenes][heights]") {
    const std::string air = "[atmosphere]\nsounding = \"sonde.csv\"\n";
    const Read r(small_scene() + air, inversion);
    const AirByHeight rule = air_by_height(r.scene, r.weather);
    const AirState station{.temperature = 291.0, .pressure = 97700.0, .vapour_pressure = 1800.0};
    // At 323 m the sonde has 18.69 °C; what the weather is off by fades over 1.5 km.
    const double off = 291.0 - (273.15 + 18.0 + 6.0 * 23.0 / 200.0);
    CHECK(air_at_height(rule, station, 500.0).temperature ==
          Approx(297.15 + off * (1.0 - 177.0 / 1500.0)).margin(0.01));
    const Read reported(with_weather("lapse = -6.5\n") + air, inversion);
    CHECK(air_at_height(air_by_height(reported.scene, reported.weather), station, 1323.0)
              .temperature == Approx(284.5));
    CHECK_THAT(problem(small_scene() + "[atmosphere]\nsounding = \"none.csv\"\n"),
               Catch::Contains("sounding"));
}

TEST_CASE("the weather's height is given, the file's, or the ground's at the site",
          "[scenes][heights]") {
    CHECK(Read(small_scene()).weather.height == Approx(323.0));
    CHECK(Read(with_weather("height_m = 150.0\n")).weather.height == Approx(150.0));
    CHECK(air_by_height(Read(with_weather("lapse = 4.0\n")).scene, Weather{}).lapse ==
          Approx(4e-3));
    CHECK(air_by_height(Read(with_weather("lapse = 0\n")).scene, Weather{}).same_everywhere());
    CHECK_THAT(problem(with_weather("lapse = \"profil\"\n")), Catch::Contains("profile"));
    CHECK_THAT(problem(with_weather("lapse = 400\n")), Catch::Contains("weather.lapse"));
}

TEST_CASE("notes report heights, and hollows without cold-air pools", "[scenes][heights]") {
    const auto note = [](const std::string& keys) {
        const Read r(with_weather(keys));
        return height_note(r.scene, r.world, r.weather);
    };
    CHECK_THAT(note(""), Catch::Contains("250 to 1450 m") && Catch::Contains("-6.5 K/km") &&
                             !Catch::Contains("cold-air pools"));
    CHECK_THAT(note("height_m = 900.0\n"), Catch::Contains("cold-air pools"));
    CHECK_THAT(note("lapse = 0\n"), Catch::Contains("lapse is 0"));
}
