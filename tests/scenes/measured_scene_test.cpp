#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "materials/matter/broadband.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/light_heights.hpp"
#include "scenes/job/run/measured_materials.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

// A scene under measured weather: what is taken from the file, and what is reported of it.

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
    CHECK(notes_of(untold).find("weather: modelled, not measured") != std::string::npos);

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

TEST_CASE("pictures reflect the share of sunlight that was measured", "[scenes][weather][albedo]") {
    const Prepared grass = prepared("measured_over = \"grass\"\n");
    const Instant noon = later(grass.scene.time.start, 12.0 * 3600.0);
    const auto materials = measured_materials(grass, noon);
    REQUIRE(materials);
    const MaterialLibrary& own = grass.scene.materials;
    const MaterialId id = own.find("grass"), other = own.find("asphalt");
    // 125 of 500 W/m² were measured; heat radiates as before.
    CHECK(solar_mean((*materials)[id].reflectance) == Approx(0.25).margin(1e-6));
    CHECK((*materials)[id].reflectance.at(10.0) == Approx(own[id].reflectance.at(10.0)));
    CHECK((*materials)[other].reflectance.value == own[other].reflectance.value);
    CHECK_FALSE(measured_materials(prepared(""), noon));
}

TEST_CASE("pictures have one sun and sky at all heights where the heat balance has",
          "[scenes][weather][heights]") {
    for (const bool level : {true, false}) {
        const Prepared p = prepared(level ? "lapse = 0\n" : "");
        const FacetViews none;
        const Atmosphere vacuum = Vacuum{};
        RadianceInput input{.facets = p.world.surfaces(),
                            .views = none,
                            .materials = p.scene.materials,
                            .atmosphere = vacuum,
                            .temperature = {},
                            .ground_height_km = p.world.sea_level_height / 1000.0};
        set_light_heights(p, input);
        const auto height = [&](std::size_t f) { return input.height_km(surface_id(f)); };
        double least = 1e9, most = -1e9;
        for (std::size_t f = 0; f < p.world.surfaces().size(); ++f) {
            least = std::min(least, height(f));
            most = std::max(most, height(f));
        }
        CAPTURE(level, least, most);
        if (level) {
            CHECK(least == input.ground_height_km);
            CHECK(most == input.ground_height_km);
        } else {
            CHECK(most - least > 0.05);
            CHECK(input.light_edge_km == Approx(input.ground_height_km + 2.3));
        }
    }
}

TEST_CASE("a scene is refused a day that its weather file does not hold",
          "[scenes][weather][errors]") {
    const ScratchFolder folder("january");
    write_text(folder.path / "scene.toml",
               with(small_scene(), "start = 2026-07-15", "start = 2026-01-15"));
    CHECK_THROWS_WITH(prepare(read_scene(folder.path / "scene.toml")),
                      Catch::Contains("weather.csv: has weather from 2026-07-15T04:00:00Z to "
                                      "2026-07-16T04:00:00Z, expected 2026-01-15T04:00:00Z to "
                                      "2026-01-16T04:00:00Z"));
}

namespace {

/// Weather from the 12th to the 16th without the 13th's hours from 6 to 18.
std::string holed_weather() {
    std::string text = "time,air_temperature_K\n";
    for (int h = 0; h <= 96; ++h) {
        if (h > 30 && h < 42) continue;
        text +=
            fmt::format("2026-07-{:02}T{:02}:00:00-04:00,{}\n", 12 + h / 24, h % 24, 290 + h % 24);
    }
    return text;
}

/// The small scene on the 15th under it, with keys for [weather] and [time].
Prepared under_holes(const std::string& weather, const std::string& time) {
    const ScratchFolder folder("holes");
    write_text(folder.path / "holes.csv", holed_weather());
    std::string scene =
        with(small_scene(), "interval = \"instant\"\n", "interval = \"instant\"\n" + weather);
    scene = with(scene, "step_s = 1200.0\n", "step_s = 1200.0\n" + time);
    const std::string file = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv";
    write_text(folder.path / "scene.toml", with(scene, file, (folder.path / "holes.csv").string()));
    return prepare(read_scene(folder.path / "scene.toml"));
}

}  // namespace

TEST_CASE("gaps in the days that a start is found from are gaps", "[scenes][weather][gaps]") {
    const std::string hole = "no weather between 2026-07-13T10:00:00Z and 2026-07-13T22:00:00Z";
    CHECK_THROWS_WITH(under_holes("", ""),
                      Catch::Contains(hole) && Catch::Contains("the days before the span"));
    CHECK_THROWS_WITH(under_holes("", "spin_up = \"weather\"\nspin_up_days = 2\n"),
                      Catch::Contains(hole));
    // Eleven rows that are not there, reported of as filled.
    const std::string filled = notes_of(under_holes("on_gap = \"interpolate\"\n", ""));
    CAPTURE(filled);
    CHECK(filled.find("11 air_temperature_K by linear interpolation") != std::string::npos);
    // Starts that do not go so far back do not ask for it.
    for (const char* time :
         {"spin_up_days = 1\n", "spin_up = \"periodic\"\n", "spin_up = \"steady\"\n"}) {
        CAPTURE(time);
        CHECK(notes_of(under_holes("", time)).find("filled") == std::string::npos);
    }
}
