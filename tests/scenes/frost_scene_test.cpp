#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
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
// reports no start: such facets stayed 0.1 K off for ever.
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

TEST_CASE("the plan includes the cost of freezing ground", "[scenes][frost]") {
    const auto heat_of = [](const Plan& plan) {
        double seconds = 0.0;
        for (const auto& stage : plan.stages) {
            if (stage.stage == StageId::heat_balance) seconds += stage.seconds;
        }
        return seconds;
    };
    const ScratchFolder folder("frost-plan");
    write_text(folder.path / "scene.toml", small_scene());
    const Plan january_plan = january().plan,
               july = prepare(read_scene(folder.path / "scene.toml")).plan;
    // Side by side a freezing facet takes 3 ms a day (of this ground a part is forest, which does
    // not freeze so), one that sees a building a twentieth of that.
    CHECK(heat_of(january_plan) / double(january_plan.facets) >
          3.0 * heat_of(july) / double(july.facets));
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

namespace {

/// A low hill of one material, with patches of others and further objects, through a day of
/// weather.
Prepared patches(const std::string& ground, const std::vector<std::string>& materials,
                 const std::string& day, double mean, double swing, double humidity, double rain,
                 double step, const std::string& objects = "") {
    const ScratchFolder folder("patches");
    std::string raster = "ncols 12\nnrows 12\nxllcorner 500000\nyllcorner 5205000\ncellsize 10\n";
    for (int i = 0; i < 144; ++i) {
        const double x = i % 12 - 5.5, y = i / 12 - 5.5;
        raster += fmt::format("{:.2f}{}", 500.0 + 12.0 * std::exp(-(x * x + y * y) / 12.0),
                              i % 12 == 11 ? "\n" : " ");
    }
    write_text(folder.path / "hill.asc", raster);
    write_text(folder.path / "hill.prj",
               "PROJCS[\"u\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
               "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
               "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER["
               "\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_"
               "easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
    std::string weather =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,cloud_fraction,rain_mm_h\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format(
            "{}T{:02}:00:00Z,{:.2f},{},1.5,0,{}\n",
            h < 24 ? day : day.substr(0, 8) + fmt::format("{:02}", std::stoi(day.substr(8)) + 1),
            h % 24, mean + swing * std::cos((h - 14) / 12.0 * M_PI), humidity,
            h > 2 && h < 6 ? rain : 0.0);
    }
    write_text(folder.path / "weather.csv", weather);
    std::string scene =
        fmt::format("[terrain]\nelevation = \"hill.asc\"\nmaterial = \"{}\"\n", ground);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        scene += fmt::format(
            "[[ground]]\nname = \"p{}\"\nmaterial = \"{}\"\nrectangle_m = [{}, {}, 16.0, 16.0, "
            "0.0]\nlargest_edge_m = 20.0\n",
            i, materials[i], 20.0 * double(i % 4) - 30.0, 20.0 * double(i / 4) - 20.0);
    }
    write_text(folder.path / "scene.toml",
               scene + objects +
                   fmt::format("[weather]\nfile = \"weather.csv\"\n[time]\nstart = "
                               "{}T00:00:00Z\nduration_h = 24.0\nstep_s = {}\n"
                               "[[observer]]\nname = \"o\"\nplace_m = [0.0, -50.0]\n"
                               "height_above_ground_m = 30.0\nlook_at_m = [0.0, 0.0]\n"
                               "bands = [\"8-12\"]\n",
                               day, step));
    return prepare(read_scene(folder.path / "scene.toml"));
}

}  // namespace

TEST_CASE("days of frost, dew, rain and melting snow repeat within the tolerance",
          "[scenes][frost][converges]") {
    const std::vector<std::string> hard{"painted_sheet", "concrete",      "asphalt",   "glass",
                                        "sandy_soil",    "clay_soil_wet", "snow_fine", "ice",
                                        "water",         "canvas",        "wood",      "gravel"};
    struct Day {
        const char *ground, *day;
        double mean, swing, humidity, rain;
    };
    const Day day = GENERATE(Day{"bare_soil", "2026-01-15", 273.3, 4.0, 0.85, 0.0},
                             Day{"dry_grass", "2026-09-10", 285.0, 6.0, 0.95, 0.0},
                             Day{"dry_grass", "2026-10-10", 283.0, 3.0, 0.90, 2.0},
                             Day{"snow", "2026-04-10", 273.5, 6.0, 0.7, 0.0});
    const double step = GENERATE(1200.0, 3600.0);
    const Prepared prepared =
        patches(day.ground, hard, day.day, day.mean, day.swing, day.humidity, day.rain, step);
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent);
    CAPTURE(day.day, step, result.report.passes, result.report.estimated_error);
    CHECK(result.report.converged);
    CHECK(result.report.unsolved.empty());
    CHECK(result.report.estimated_error <= SolveOptions{}.settled);
    CHECK(result.report.worst_energy_closure < 1e-6);
    CHECK(not_converged(result.report).empty());
}

TEST_CASE("frosty ground in the lee of a warm generator repeats its day",
          "[scenes][frost][converges]") {
    // Frost on ground in a lee once had the film of open ground, so that facets went from one film
    // to the other and back whenever their neighbours' heat shifted the hour of freezing.
    const Prepared prepared =
        patches("grass", {}, "2026-01-10", 271.0, 6.0, 0.95, 0.0, 1200.0,
                "[[object]]\nname = \"g\"\nmodel = \"generator\"\nplace_m = [0.0, 0.0]\ndetail = "
                "\"low\"\nrunning = [\"00:00-12:00\"]\n");
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent);
    CAPTURE(result.report.passes, result.report.estimated_error, result.report.stores);
    CHECK(result.report.stores > 50);
    CHECK(result.report.converged);
    CHECK(result.report.passes <= 8);
}
