#include "scenes/job/warnings/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// What can be computed but is implausible, and sample scenes that are meant as they are.

namespace {

namespace fs = std::filesystem;

const ScratchFolder& folder() {
    static const ScratchFolder scratch("doubts");
    return scratch;
}

/// A closed box of 2 m, its lowest point at 0.
std::string box_mesh() {
    const fs::path file = folder().path / "box.obj";
    write_text(file,
               "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
               "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n");
    return "box.obj";
}

std::string box(const std::string& name, const std::string& rest) {
    return "[[object]]\nname = \"" + name + "\"\nmesh = \"" + box_mesh() +
           "\"\nmaterial = \"painted_sheet\"\nstands = \"upright\"\n" + rest + "\n";
}

Scene scene_of(const std::string& text) {
    const fs::path file = folder().path / "scene.toml";
    write_text(file, text);
    return read_scene(file, {}, true);
}

std::vector<std::string> warnings_of(const std::string& text) {
    return as_lines(scene_warnings(prepare(scene_of(text))));
}

bool reported(const std::vector<std::string>& lines, const std::string& one,
              const std::string& other = "") {
    for (const std::string& line : lines) UNSCOPED_INFO(line);
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(one) != std::string::npos && line.find(other) != std::string::npos;
    });
}

}  // namespace

TEST_CASE("sample scenes raise no warning", "[scenes][warnings]") {
    const std::string name =
        GENERATE("jacksboro", "approach", "camouflage", "crossover", "instruments");
    CAPTURE(name);
    const auto lines = as_lines(scene_warnings(
        prepare(read_scene(fs::path(DIURNA_SOURCE_DIR "/scenes") / name / "scene.toml"))));
    for (const std::string& line : lines) UNSCOPED_INFO(line);
    CHECK(lines.empty());
}

TEST_CASE("objects that overlap, float or are below the ground raise warnings",
          "[scenes][warnings]") {
    const std::string base = small_scene();
    SECTION("beside one another, touching, on top: fine") {
        CHECK(warnings_of(base + box("a", "place_m = [300.0, 900.0]") +
                          box("b", "place_m = [302.0, 900.0]") +
                          box("c", "place_m = [310.0, 900.0]"))
                  .empty());
    }
    SECTION("half a metre into the next") {
        const auto lines = warnings_of(base + box("a", "place_m = [300.0, 900.0]") +
                                       box("b", "place_m = [301.5, 900.3]"));
        CHECK(lines.size() == 1);
        CHECK(reported(lines, "object.b.place_m", "intersects \"a\""));
    }
    SECTION("within the hangar") {
        const auto lines = warnings_of(base + box("truck", "place_m = [53.0, -88.4]"));
        CHECK(lines.size() == 1);
        CHECK(reported(lines, "object.truck.place_m", "is inside \"hangar\""));
    }
    SECTION("through its wall: 20 m from its middle along its heading of 45 degrees") {
        const double aside = 20.0 * std::sqrt(0.5);
        CHECK(reported(
            warnings_of(base + box("truck", "place_m = [" + std::to_string(53.0 + aside) + ", " +
                                                std::to_string(-88.4 + aside) + "]")),
            "object.truck.place_m", "intersects \"hangar\""));
    }
    SECTION("5 m over the ground") {
        const auto lines =
            warnings_of(base + box("a", "place_m = [300.0, 900.0]\nheight_above_ground_m = 5.0"));
        CHECK(lines.size() == 1);
        CHECK(reported(lines, "object.a", "floats "));
        CHECK(reported(lines, "height_above_ground_m = 0"));
        // In flight it may.
        CHECK(warnings_of(base + box("a",
                                     "place_m = [300.0, 900.0]\nheight_above_ground_m = 5.0\n"
                                     "airspeed_m_s = 50.0"))
                  .empty());
    }
    SECTION("sunk by 1.5 of its 2 m") {
        CHECK(reported(warnings_of(base + box("a",
                                              "place_m = [300.0, 900.0]\n"
                                              "height_above_ground_m = -1.5")),
                       "object.a", "is sunk 1."));
    }
    SECTION("a thousand times as small") {
        CHECK(reported(warnings_of(base + box("a", "place_m = [300.0, 900.0]\nscale = 0.001")),
                       "object.a", "has a size of 0.002 m"));
    }
    SECTION("a hundred and more times as large") {
        CHECK(reported(warnings_of(base + box("a",
                                              "place_m = [300.0, 900.0]\nscale = 160.0\n"
                                              "largest_edge_m = 50.0\nground_edge_m = 50.0")),
                       "object.a", "has a size of 320 m"));
    }
}

TEST_CASE("cameras that see nothing and places in degrees raise warnings", "[scenes][warnings]") {
    const std::string base = small_scene();
    const auto eye = [](const std::string& rest) {
        return "[[observer]]\nname = \"eye\"\nwidth = 64\nheight = 48\n" + rest + "\n";
    };
    CHECK(reported(
        warnings_of(base +
                    eye("place_m = [0.0, 900.0]\nheight_above_ground_m = 2.0\nazimuth_deg = 10.0\n"
                        "elevation_deg = 60.0")),
        "observer.eye", "nothing but sky"));
    // 0.2 m before the southern side of a box of 2 m.
    CHECK(reported(
        warnings_of(base + box("a", "place_m = [300.0, 900.0]") +
                    eye("place_m = [300.0, 898.8]\nheight_above_ground_m = 1.0\n"
                        "azimuth_deg = 0.0\nelevation_deg = 0.0\nhorizontal_fov_deg = 20.0")),
        "observer.eye", "directly in front of its lens"));
    // The site is 36.32 N 84.203 W.
    CHECK(reported(warnings_of(base + box("a", "place_m = [-84.21, 36.33]")), "object.a.place_m",
                   "look like longitude and latitude"));
    CHECK(reported(warnings_of(base + box("a", "place_m = [36.33, -84.21]")), "object.a.place_m",
                   "look like latitude and longitude"));
}

TEST_CASE("a schedule whose clock is not the sun's raises a warning", "[scenes][warnings]") {
    // At 84.2 W the mean sun is 5 h 37 min behind UTC, 1 h 37 min behind UTC-4.
    const std::string warm =
        "[material.warm]\nlike = \"concrete\"\ninternal_schedule = [[8, 0], [9, 50]]\n"
        "[[ground]]\nname = \"pad\"\nmaterial = \"warm\"\n"
        "rectangle_m = [300.0, 900.0, 20.0, 20.0, 0.0]\n";
    const auto lines = warnings_of(small_scene() + warm);
    CHECK(lines.size() == 1);
    CHECK(reported(lines, "material.warm.internal_schedule", "1 h 37 min behind that clock"));
    CHECK(warnings_of(small_scene()).empty());
}

TEST_CASE("check prints warnings, and --strict makes them errors", "[scenes][warnings]") {
    const fs::path scene = folder().path / "scene.toml", reported_file = folder().path / "told.txt";
    write_text(scene, small_scene() + box("truck", "place_m = [53.0, -88.4]"));
    const auto verb = [&](const std::string& arguments) {
        return WEXITSTATUS(std::system(("'" DIURNA_BINARY "' " + arguments + " '" + scene.string() +
                                        "' --allow-outside >'" + reported_file.string() + "' 2>&1")
                                           .c_str()));
    };
    CHECK(verb("check") == 0);
    CHECK(read_text(reported_file).find("warning: ") != std::string::npos);
    CHECK(read_text(reported_file).find(": 1 warning, ") != std::string::npos);
    CHECK(verb("check --strict") == 2);
    CHECK(read_text(reported_file).find("is inside \"hangar\"") != std::string::npos);
    const fs::path out = folder().path / "out";
    CHECK(verb("run --set time.duration_h=0.5 --out '" + out.string() + "'") == 0);
    CHECK(read_text(out / "report.html").find("is inside &quot;hangar&quot;") != std::string::npos);
}

TEST_CASE("mistyped names are reported with the nearest name", "[scenes][warnings]") {
    const auto refusal = [](const std::string& text) {
        try {
            scene_of(text);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string base = small_scene();
    const std::string tarmac = refusal(with(base, "\"asphalt\"", "\"tarmac\""));
    CHECK(tarmac.find("unknown material \"tarmac\" (did you mean 'asphalt'? `diurna materials`") !=
          std::string::npos);
    CHECK(refusal(with(base, "\"asphalt\"", "\"Asphalt\"")).find("did you mean 'asphalt'?") !=
          std::string::npos);
    // Band names in any case, in the words that files have.
    CHECK(scene_of(with(base, "[\"3-5\", \"8-12\"]", "[\"LWIR\", \"Mwir\"]")).observers[0].bands ==
          std::vector<std::string>{"lwir", "mwir"});
}

TEST_CASE("weather of minutes under steps of 20 minutes raises a warning with what is missed",
          "[scenes][warnings]") {
    // Sun of 800 and 200 W/m2 for four minutes each: steps meet both by turns, and the straight
    // line between them is 500 +- 300 t. Rows are +- 300 about 500, whatever the line: the rms of
    // the difference is sqrt(300^2 + 300^2 / 3) = 346 W/m2.
    std::string rows =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,shortwave_down_W_m2\n";
    for (int minute = 0; minute <= 1440; ++minute) {
        rows += fmt::format("2026-07-{:02}T{:02}:{:02}:00-04:00,295,0.5,2,{}\n", 15 + minute / 1440,
                            minute / 60 % 24, minute % 60,
                            minute < 540 || minute > 1020 ? 0 : (minute / 4 % 2 ? 800 : 200));
    }
    write_text(folder().path / "minutes.csv", rows);
    const std::string scene =
        with(small_scene(), std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv",
             "minutes.csv");
    const auto of_step = [](const std::vector<std::string>& lines) {
        for (const std::string& line : lines) {
            if (line.find("time.step_s: ") != std::string::npos) return line;
        }
        return std::string();
    };
    const std::string line = of_step(warnings_of(scene));
    CAPTURE(line);
    REQUIRE(line.find("a row every 60 s, the heat balance a step every 1200 s") !=
            std::string::npos);
    CHECK(std::stod(line.substr(line.find("differs by ") + 11)) == Approx(346.0).epsilon(0.1));
    CHECK(line.find("set time.step_s = 60") != std::string::npos);
    CHECK(of_step(warnings_of(with(scene, "step_s = 1200.0", "step_s = 60.0"))).empty());
}
