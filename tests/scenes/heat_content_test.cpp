#include "scenes/job/store/heat_content.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/app/sweep/run_sweep.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/studies/sensitivity_study.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/small_scene.hpp"

// Scenes that give the heat balance the same numbers have the same temperatures, whatever their
// files say; scenes that give it others do not pass for the same.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

/// The small scene on level weather with every light measured: a formula, no data.
///
/// - light: columns with sunlight and longwave; else these are computed from the air
std::string lit_scene(const ScratchFolder& folder, bool light, const std::string& more = "") {
    std::string weather = "time,air_temperature_K,relative_humidity,wind_speed_m_s";
    if (light) weather += ",shortwave_down_W_m2,direct_normal_W_m2,diffuse_W_m2,longwave_down_W_m2";
    for (int h = 0; h <= 72; ++h) {
        const double up = std::sin((h % 24 - 6.0) / 12.0 * std::numbers::pi);
        weather += fmt::format("\n2026-07-{:02}T{:02}:00:00-04:00,{:.3f},0.5,2.0", 14 + h / 24,
                               h % 24, 290.0 + 6.0 * up);
        if (!light) continue;
        const double sun = std::max(0.0, up);
        weather += fmt::format(",{:.3f},{:.3f},{:.3f},{:.3f}", 800.0 * sun, 700.0 * sun,
                               100.0 * sun, 350.0);
    }
    write_text(folder.path / "formula.csv", weather + "\n");
    std::string text =
        with(small_scene(), DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv", "formula.csv");
    text = with(text, "radius_m = 4000.0", "radius_m = 2600.0");
    text = with(text, "frame_every_s = 21600.0", "frame_every_s = 43200.0");
    // Of measured sunlight its course between readings and the cloud are the clear sky's by the
    // formulas, whose haze is the visibility's unless the scene gives it.
    const std::string sky = light ? "[sky]\naerosol_380nm = 0.2\naerosol_500nm = 0.15\n" : "";
    return text + "[atmosphere]\ndrives_heat = false\nvisibility_km = 23.0\n" + sky + more;
}

std::string content(const ScratchFolder& folder, const std::vector<std::string>& settings) {
    return heat_content(prepare(read_scene(folder.path / "scene.toml", settings, true)));
}

}  // namespace

TEST_CASE(
    "what changes no number of the heat balance leaves its content, what changes one does not",
    "[scenes][heat_content]") {
    const ScratchFolder folder("heat_content");
    write_text(folder.path / "scene.toml", lit_scene(folder, true));
    const std::string base = content(folder, {});
    CHECK(base == content(folder, {}));
    for (const char* same :
         {"observer.east.height_above_ground_m=400.0", "observer.east.bands=[\"8-12\"]",
          "scene.name=\"other\"", "weather.changed.wind_factor=1.0",
          "weather.changed.air_temperature_offset_K=0.0", "labels.bits=8",
          "time.frame_every_s=7200.0", "tolerance_K=0.0"}) {
        CAPTURE(same);
        CHECK(content(folder, {same}) == base);
    }
    // A material of the scene's own, with the numbers of the library's.
    CHECK(content(folder, {"material.grass.like=\"grass\"", "material.grass.emissivity=0.9"}) !=
          base);
    for (const char* other :
         {"weather.changed.wind_factor=1.01", "weather.changed.air_temperature_offset_K=0.01",
          "weather.changed.humidity_factor=1.01", "weather.changed.sunlight_factor=1.01",
          "ground.runway.material=\"concrete\"", "building.hangar.heading_deg=45.5",
          "scene.sky_rays=33", "scene.seed=2", "time.step_s=600.0", "time.duration_h=23.0",
          "site.latitude_deg=36.33"}) {
        CAPTURE(other);
        CHECK(content(folder, {other}) != base);
    }
}

TEST_CASE("visibility is part of heat where light is computed from it, and only there",
          "[scenes][heat_content]") {
    const ScratchFolder folder("heat_content_haze");
    const std::vector<std::string> haze{"atmosphere.visibility_km=12.0"};
    write_text(folder.path / "scene.toml", lit_scene(folder, true));
    const std::string both = haze.front();
    CHECK(content(folder, {both, "weather.lapse=0.0"}) == content(folder, {"weather.lapse=0.0"}));
    // Not measured: from the formulas with the haze, or from the air.
    write_text(folder.path / "scene.toml", lit_scene(folder, false));
    CHECK(content(folder, haze) != content(folder, {}));
    const std::string driven = "atmosphere.drives_heat=true";
    CHECK(content(folder, {both, driven}) != content(folder, {driven}));
}

TEST_CASE("a sweep solves as many heats as differ, also of zipped axes", "[scenes][heat_content]") {
    const ScratchFolder folder("heat_content_sweep");
    const std::string axes = R"([sweep]
[[sweep.axis]]
name = "haze and camera"
keys = ["atmosphere.visibility_km", "observer.east.height_above_ground_m"]
values = [[23.0, 450.0], [12.0, 450.0], [12.0, 400.0]]
[[sweep.axis]]
name = "paint and camera"
keys = ["building.hangar.roof", "observer.east.horizontal_fov_deg"]
values = [["painted_steel", 24.0], ["painted_steel", 20.0]]
)";
    std::string text = with(lit_scene(folder, true, axes), "[weather]", "[weather]\nlapse = 0.0\n");
    write_text(folder.path / "scene.toml", text);
    const Sweep sweep = read_sweep_variants(folder.path / "scene.toml", {}, true);
    REQUIRE(sweep.variants.size() == 6);
    CHECK(sweep.solves() == 2);  // by the values of the keys that may change temperatures
    SweepOptions options;
    options.out = folder.path / "out";
    const SweepReport report = run_sweep(sweep, options);
    CHECK(report.rendered == 6);
    CHECK(report.solved == 1);  // by content
    // Both heats hold what each scene alone has.
    for (const char* heat : {"h0", "h1"}) {
        const std::string haze = std::string("atmosphere.visibility_km=") +
                                 (std::string(heat) == "h0" ? "23.0" : "12.0");
        const fs::path alone = folder.path / heat;
        const std::string command = "'" DIURNA_BINARY "' solve '" +
                                    (folder.path / "scene.toml").string() +
                                    "' --allow-outside --set '" + haze + "' --out '" +
                                    alone.string() + ".nc' >/dev/null 2>&1";
        REQUIRE(std::system(command.c_str()) == 0);
        const auto numbers = [](const fs::path& file) {
            return load_temperature_field(file).kelvin;
        };
        CHECK((numbers(options.out / "heat" / heat / "temperatures.nc") ==
               numbers(alone.string() + ".nc")));
    }
}

TEST_CASE("a study solves nothing for a visibility that is no part of heat",
          "[scenes][heat_content]") {
    const ScratchFolder folder("heat_content_study");
    const std::string study = R"([[sensitivity]]
trajectories = 0
uncertain = [{ key = "atmosphere.visibility_km", low = 12.0, high = 40.0 }]
output = [
    { first = "runway", at_h = 14.0 },
    { first = "runway", second = "ground", figure = "contrast", observer = "east", band = "8-12", at_h = 14.0 },
]
)";
    std::string text =
        with(lit_scene(folder, true, study), "[weather]", "[weather]\nlapse = 0.0\n");
    write_text(folder.path / "scene.toml",
               with(text, "width = 64\nheight = 48", "width = 256\nheight = 192"));
    StudyRequest request{.scene = folder.path / "scene.toml", .allow_outside = true};
    const StudyFindings found = sensitivity_study(request);
    const auto json = nlohmann::json::parse(found.finding.front().texts.json);
    CHECK(json["scenes"] == 2);
    CHECK(json["scenes_solved"] == 0);
    CHECK(json["outputs"][0]["uncertain"][0]["slope"] == 0.0);
    // The air before the camera is another's all the same.
    CHECK(json["outputs"][1]["uncertain"][0]["slope"] != 0.0);
}
