#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/world/measured_albedo.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

// A scene under measured weather: what is taken from the file, and what is told of it.

using namespace diurna;

namespace {

/// The default scene's weather with sun and what grass reflects of it.
std::string measured_weather() {
    std::string text =
        "time,air_temperature_K,shortwave_down_W_m2,diffuse_W_m2,shortwave_up_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        text +=
            fmt::format("2026-07-{:02}T{:02}:00:00-04:00,290,500,100,125\n", 15 + h / 24, h % 24);
    }
    return text;
}

Prepared prepared(const std::string& keys) {
    const ScratchFolder folder("measured-scene");
    write_text(folder.path / "measured.csv", measured_weather());
    const std::string scene =
        with(small_scene(), "interval = \"instant\"\n", "interval = \"instant\"\n" + keys);
    const std::string file = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv";
    write_text(folder.path / "scene.toml",
               with(scene, file, (folder.path / "measured.csv").string()));
    return prepare(read_scene(folder.path / "scene.toml"));
}

std::string notes_of(const Prepared& p) {
    std::string all;
    for (const std::string& note : p.notes) all += note + "\n";
    return all;
}

}  // namespace

TEST_CASE("reflected light is used for the material it was measured over, or not at all",
          "[scenes][weather][albedo]") {
    const Prepared untold = prepared("");
    CAPTURE(notes_of(untold));
    CHECK(measured_albedo(untold.scene, untold.world, untold.weather).share.empty());
    CHECK(notes_of(untold).find("shortwave_up is not used") != std::string::npos);
    CHECK(notes_of(untold).find("weather: not measured, modelled") != std::string::npos);

    const Prepared grass = prepared("measured_over = \"grass\"\n");
    const MeasuredAlbedo measured = measured_albedo(grass.scene, grass.world, grass.weather);
    const MaterialLibrary& materials = grass.scene.materials;
    REQUIRE(measured.share.size() == materials.size());
    CHECK(measured.share[index(materials.find("grass"))] == 1.0);
    CHECK(measured.share[index(materials.find("asphalt"))] == 0.0);
    CHECK(notes_of(grass).find("shortwave_up") == std::string::npos);

    const Prepared sand = prepared("measured_over = \"sand\"\n");
    CHECK(notes_of(sand).find("no surface is of \"sand\"") != std::string::npos);
}

TEST_CASE("a scene is refused a day that its weather file does not hold",
          "[scenes][weather][errors]") {
    const ScratchFolder folder("january");
    write_text(folder.path / "scene.toml",
               with(small_scene(), "start = 2026-07-15", "start = 2026-01-15"));
    CHECK_THROWS_WITH(prepare(read_scene(folder.path / "scene.toml")),
                      Catch::Contains("weather.csv: holds weather from 2026-07-15T04:00:00Z to "
                                      "2026-07-16T04:00:00Z; asked for 2026-01-15T04:00:00Z to "
                                      "2026-01-16T04:00:00Z"));
}
