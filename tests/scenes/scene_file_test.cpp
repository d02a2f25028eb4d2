#include "scenes/job/input/scene_file.hpp"

#include <catch2/catch.hpp>

#include "materials/base/error.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

std::vector<Mistake> mistakes_of(const std::string& text) {
    const ScratchFolder folder("scene-file");
    const auto file = folder.path / "scene.toml";
    write_text(file, text);
    try {
        read_scene(file);
    } catch (const InputError& error) {
        return error.mistakes();
    }
    return {};
}

}  // namespace

TEST_CASE("the default scene reads as it is written", "[scenes][scene_file]") {
    const Scene scene = read_scene(DIURNA_SOURCE_DIR "/scenes/jacksboro/scene.toml");
    CHECK(scene.name == "jacksboro");
    CHECK(scene.terrain.polygons.size() == 6);
    CHECK(scene.terrain.buildings.size() == 1);
    CHECK(scene.terrain.objects.size() == 2);
    CHECK(scene.terrain.objects.at(0).mesh->part.size() == 8);
    CHECK(scene.observers.at(0).width == 640);
    CHECK(scene.observers.at(0).height == 512);
    CHECK(scene.time.duration == 86400.0);
    CHECK(format_instant(scene.time.start) == "2026-07-15T04:00:00Z");
    // The runway: 1500 m along 45 degrees, 45 m across.
    const auto& ring = scene.terrain.polygons.at(1).ring;
    REQUIRE(ring.size() == 4);
    CHECK((ring[2] - ring[1]).norm() == Approx(1500.0));
    CHECK((ring[1] - ring[0]).norm() == Approx(45.0));
    CHECK((ring[2] - ring[1]).normalized().x() == Approx(std::sqrt(0.5)));
}

TEST_CASE("mistakes of a scene carry place, expectation and the nearest word",
          "[scenes][scene_file]") {
    REQUIRE(mistakes_of(small_scene()).empty());

    auto found = mistakes_of(with(small_scene(), "tolerance_m", "tolerence_m"));
    REQUIRE(found.size() == 1);
    CHECK(found[0].line().find("scene.toml:10:1: terrain.tolerence_m: unknown key") !=
          std::string::npos);
    CHECK(found[0].hint == "did you mean 'tolerance_m'?");

    found = mistakes_of(with(small_scene(), "\"asphalt\"", "\"asfalt\""));
    REQUIRE(found.size() == 1);
    CHECK(found[0].where.find(":17:12: ground.material") != std::string::npos);
    CHECK(found[0].problem == "unknown material \"asfalt\"");
    CHECK(found[0].hint == "did you mean 'asphalt'? `diurna materials` lists the library");

    found = mistakes_of(with(with(small_scene(), "width = 64", "width = 0"), "\"3-5\"", "\"5-3\""));
    REQUIRE(found.size() == 2);
    CHECK(found[0].where.find("observer.width") != std::string::npos);
    CHECK(found[1].where.find("observer.bands") != std::string::npos);
}

TEST_CASE("a scene without observer, elevation or weather says so in one line each",
          "[scenes][scene_file]") {
    const std::string blind = small_scene().substr(0, small_scene().find("[[observer]]"));
    auto found = mistakes_of(blind);
    REQUIRE(found.size() == 1);
    CHECK(found[0].problem ==
          "missing, expected at least one table [[observer]] or [[radiometer]]");

    found = mistakes_of(with(small_scene(), "elevation.tif", "nowhere.tif"));
    REQUIRE(found.size() == 1);
    CHECK(found[0].problem.find("no such file: ") == 0);
    CHECK(found[0].where.find("terrain.elevation") != std::string::npos);

    found = mistakes_of("");
    CHECK(found.size() ==
          4);  // terrain, weather, time, observer; and nothing that follows from them
}

TEST_CASE("a start without its offset is refused", "[scenes][scene_file]") {
    const auto found = mistakes_of(
        with(small_scene(), "start = 2026-07-15T00:00:00-04:00", "start = 2026-07-15T00:00:00"));
    REQUIRE(found.size() == 1);
    CHECK(found[0].problem.find("offset") != std::string::npos);
}

TEST_CASE("names of objects are not given twice", "[scenes][scene_file]") {
    const auto found = mistakes_of(with(small_scene(), "name = \"hangar\"", "name = \"runway\""));
    REQUIRE(found.size() == 1);
    CHECK(found[0].problem == "a second object named \"runway\"");
}

TEST_CASE("no pixel looks round the back of the sphere", "[scenes][scene_file]") {
    const auto reported = [](const std::string& keys) {
        std::string all;
        for (const Mistake& mistake : mistakes_of(with(
                 small_scene(), "horizontal_fov_deg = 24.0\nwidth = 64\nheight = 48\n", keys))) {
            all += mistake.line() + " " + mistake.hint + "\n";
        }
        return all;
    };
    // 360 degrees on 640 columns are 320 rows from pole to pole.
    const std::string tall = reported(
        "projection = \"panorama\"\nhorizontal_fov_deg = 360.0\nwidth = 640\nheight = 512\n");
    CHECK(tall.find("observer.height: the rows of the panorama span 288 degrees") !=
          std::string::npos);
    CHECK(tall.find("height = 320") != std::string::npos);
    CHECK(reported(
              "projection = \"panorama\"\nhorizontal_fov_deg = 360.0\nwidth = 640\nheight = 320\n")
              .empty());
    // The corners of a square of 360 degrees are 254 off the axis; 254.6 is where they are 180.
    const std::string square = reported(
        "projection = \"equidistant\"\nhorizontal_fov_deg = 360.0\nwidth = 64\nheight = 64\n");
    CHECK(square.find("have directions behind it") != std::string::npos);
    CHECK(square.find("horizontal_fov_deg = 254") != std::string::npos);
    CHECK(reported(
              "projection = \"equidistant\"\nhorizontal_fov_deg = 254.0\nwidth = 64\nheight = 64\n")
              .empty());
    // 2 f sin(theta / 2): a square's corner is at 180 where its side is at 90.
    const std::string even = reported(
        "projection = \"equisolid\"\nhorizontal_fov_deg = 200.0\nwidth = 64\nheight = 64\n");
    CHECK(even.find("horizontal_fov_deg = 180") != std::string::npos);
    CHECK(reported(
              "projection = \"equisolid\"\nhorizontal_fov_deg = 180.0\nwidth = 64\nheight = 64\n")
              .empty());
}
