#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/files.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/stages.hpp"
#include "tests/support/sheet_scene.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// A January day about 275 K over the default scene's valley.
Prepared january() {
    const ScratchFolder folder("frost-scene");
    std::string weather =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,shortwave_down_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        const double air = 275.0 + 4.0 * std::cos((h - 15) / 12.0 * M_PI);
        const double sun = h >= 7 && h <= 17 ? 450.0 * std::sin((h - 7) / 10.0 * M_PI) : 0.0;
        weather += fmt::format("2026-01-{:02}T{:02}:00:00-05:00,{:.2f},0.8,3,{:.1f}\n", 15 + h / 24,
                               h % 24, air, std::max(0.0, sun));
    }
    write_text(folder.path / "january.csv", weather);
    std::string scene = with(small_scene(), "radius_m = 4000.0", "radius_m = 1000.0");
    scene = with(scene, "place_m = [2000.0, 1100.0]", "place_m = [200.0, 110.0]");
    const std::size_t hangar = scene.find("[[building]]");
    scene.erase(hangar, scene.find("[weather]") - hangar);
    const std::string july = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv";
    scene = with(scene, july, (folder.path / "january.csv").string());
    write_text(folder.path / "scene.toml",
               with(scene, "2026-07-15T00:00:00-04:00", "2026-01-15T00:00:00-05:00"));
    return prepare(read_scene(folder.path / "scene.toml"));
}

}  // namespace

// Where the ground below thaws by as much each day whatever it begins with, the slope of the day
// tells no start: such facets stayed 0.1 K off for ever.
TEST_CASE("a day of frost and thaw repeats on every facet", "[scenes][frost][by_events]") {
    const Prepared prepared = january();
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent);
    CAPTURE(result.report.passes, result.report.periodic_residual);
    CHECK(result.report.points > 10);
    CHECK(result.report.converged);
    CHECK(result.report.periodic_residual < 1e-4);
    CHECK(result.report.worst_energy_closure < 1e-8);
}

TEST_CASE("the plan tells what freezing ground takes", "[scenes][frost]") {
    const auto heat_of = [](const Plan& plan) {
        double seconds = 0.0;
        for (const auto& stage : plan.stages) {
            if (stage.name == "heat balance") seconds += stage.seconds;
        }
        return seconds;
    };
    const ScratchFolder folder("frost-plan");
    write_text(folder.path / "scene.toml", small_scene());
    const Plan january_plan = january().plan,
               july = prepare(read_scene(folder.path / "scene.toml")).plan;
    // Side by side a freezing facet takes 4 ms a day, a plain one a hundredth of that.
    CHECK(heat_of(january_plan) / double(january_plan.facets) >
          10.0 * heat_of(july) / double(july.facets));
}

TEST_CASE("a drop of rain leaves a closed box its inside", "[scenes][rain]") {
    // Sheet of 1 mm with air on either side, films of 10 W/m2K, no radiation but 400 W/m2 of sun on
    // a black lid: 290 + 400 / (10 + 10) = 310 K at noon. A hundredth of a millimetre of rain at
    // two o'clock in the night is gone by then. Without its back the lid would have 330 K.
    namespace over_plain = diurna::testing::over_plain;
    for (const double rain : {0.0, 0.01}) {
        const ScratchFolder folder("drop");
        over_plain::write_scene(
            folder.path, {.mesh = over_plain::level_square(2, 0.5),
                          .beam = 400.0,
                          .black = 0.0,
                          .sheet = "back = { kind = \"exposed\", emissivity = 0.0, albedo = 1.0 }\n"
                                   "store = { capacity_mm = 0.1 }",
                          .ground_edge = 5.0});
        std::string weather = read_text(folder.path / "weather.csv"), rainy;
        for (std::size_t from = 0, row = 0, to; (to = weather.find('\n', from)) != weather.npos;
             from = to + 1, ++row) {
            rainy += weather.substr(from, to - from);
            rainy += row == 0 ? ",rain_mm_h\n" : row == 3 ? fmt::format(",{}\n", rain) : ",0\n";
        }
        write_text(folder.path / "weather.csv", rainy);
        const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
        Progress silent(ProgressStyle::silent);
        const SpanResult result = solve_scene(Stages(prepared), silent);
        CHECK((result.report.stores > 0) == (rain > 0.0));
        const std::vector<float> noon =
            result.temperature.interpolate(parse_instant("2026-03-20T12:00:00Z"));
        const FacetSet& facets = prepared.world.facets;
        for (std::size_t f = prepared.world.ground_facets; f < facets.size(); ++f) {
            if (facets.normal[f].z() < 0.9f) continue;
            CAPTURE(rain, f);
            CHECK(noon[f] == Approx(310.0).margin(0.1));
        }
    }
}
