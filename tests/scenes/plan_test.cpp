#include "scenes/job/plan/plan.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "materials/matter/passed_light.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/sky_work.hpp"
#include "scenes/job/plan/solved_days.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

// That time and memory of a plan grow with what a run does.

using namespace diurna;

namespace {

/// The small scene on 800 m, with keys of [scene] and tables behind.
Prepared scene_with(const std::string& keys, const std::string& tables = "") {
    const ScratchFolder folder("plan");
    write_text(folder.path / "crate.obj", crate_mesh);
    std::string text = with(small_scene(), "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]");
    text = with(text, "sky_rays = 32\n", keys);
    write_text(folder.path / "scene.toml", text + tables);
    return prepare(read_scene(folder.path / "scene.toml"));
}

double seconds_of(StageId stage, const Plan& plan) {
    double seconds = 0.0;
    for (const PlannedStage& one : plan.stages) {
        if (one.stage == stage) seconds += one.seconds;
    }
    return seconds;
}

/// A crate that stands at a number of places along its trajectory.
std::string crate_on_a_way(int places_of_rest) {
    std::string places, times;
    for (int i = 0; i < places_of_rest; ++i) {
        const double rest = 86400.0 / places_of_rest;
        for (const double when : {i * rest + (i > 0 ? 30.0 : 0.0), (i + 1) * rest - 30.0}) {
            places += "[" + std::to_string(-50 + 4 * i) + ".0, -50.0, 0.0], ";
            times += std::to_string(when) + ", ";
        }
    }
    return crate_object + R"(stands = "upright"
trajectory = "road"
[[trajectory]]
name = "road"
waypoints_m = [)" +
           places + "]\ntimes_s = [" + times + "]\n";
}

}  // namespace

TEST_CASE("a plan counts view factors at every stage of moving objects", "[scenes][plan]") {
    const Prepared few = scene_with("", crate_on_a_way(2)),
                   many = scene_with("", crate_on_a_way(12));
    REQUIRE(few.plan.stages_of_motion == few.movement.stage.size());
    const double more = double(many.plan.stages_of_motion) / double(few.plan.stages_of_motion);
    REQUIRE(more > 4.0);
    const auto per_facet = [](const Prepared& of, StageId stage) {
        return seconds_of(stage, of.plan) / double(of.plan.facets);
    };
    // Facets beside the way are finer, and have more rays.
    CHECK(per_facet(many, StageId::sky_view) > 0.8 * more * per_facet(few, StageId::sky_view));
    CHECK(seconds_of(StageId::surface_check, many.plan) >
          0.5 * more * seconds_of(StageId::surface_check, few.plan));
    CHECK(many.plan.memory > few.plan.memory + 400.0 * double(many.plan.facets) * (more - 1.0));
    CHECK(describe(many.plan).find("stages of moving objects") != std::string::npos);
}

TEST_CASE("a plan counts the places of the surface check", "[scenes][plan][check_points]") {
    const auto check_of = [](int places) {
        return scene_with("check_points = " + std::to_string(places) + "\n").plan;
    };
    const Plan none = check_of(0), some = check_of(128), many = check_of(4096);
    CHECK(seconds_of(StageId::surface_check, none) == 0.0);
    CHECK(describe(none).find("\n  surface check") == std::string::npos);
    CHECK(seconds_of(StageId::surface_check, many) ==
          Approx(32.0 * seconds_of(StageId::surface_check, some)));
    CHECK(none.seconds < some.seconds);
    CHECK(none.memory < some.memory);
    CHECK(some.memory < many.memory);
    CHECK(describe(many).find("4096 places") != std::string::npos);
    CHECK(many.finer_seconds > seconds_of(StageId::surface_check, many));
}

TEST_CASE("a plan foresees the rays of ground near objects", "[scenes][plan]") {
    const std::string rays = GENERATE("sky_rays = 16\nobject_sky_rays = 64\n", "sky_rays = 64\n",
                                      "sky_rays = 512\nobject_sky_rays = 512\n");
    CAPTURE(rays);
    const Prepared prepared = scene_with(rays, R"(
[[ground]]
name = "yard"
material = "concrete"
rectangle_m = [53.0, -88.4, 160.0, 120.0, 45.0]
largest_edge_m = 8.0
)");
    const SkyWork planned = sky_work(prepared.scene, prepared.world);
    const FacetViews views = scene_sky_view(prepared, false, nullptr);
    double ground = 0.0, walls = 0.0;
    for (std::size_t f = 0; f < views.rays.size(); ++f) {
        (f < prepared.world.ground_facets ? ground : walls) += views.rays[f];
    }
    CHECK(planned.wall_rays == walls);
    CHECK(planned.ground_rays > ground / 1.5);
    CHECK(planned.ground_rays < ground * 1.5);
    const double entries = double(views.others.facet.size());
    CHECK(planned.entries > entries / 2.5);
    CHECK(planned.entries < entries * 2.5);
}

TEST_CASE("a plan counts the days before a span", "[scenes][plan]") {
    const Prepared prepared = scene_with("");
    const auto days_of = [&](SpanStart begin, double days, bool moves) {
        Scene scene = prepared.scene;
        scene.time.spin_up = begin;
        scene.time.duration = 86400.0 * days;
        return solved_days(scene, prepared.world.site, prepared.weather, moves);
    };
    const SolvedDays one = days_of(SpanStart::periodic, 1.0, false);
    CHECK(one.repeated == 1.0);
    CHECK(one.steps_of_day == 73.0);
    CHECK(one.sunlit / one.steps == Approx(14.4 / 24.0).margin(0.02));  // 14 h 25 min of sun (USNO)
    // A day that repeats is solved whole, however short the span is.
    CHECK(days_of(SpanStart::periodic, 0.1, false).steps == one.steps);
    const SolvedDays three = days_of(SpanStart::periodic, 3.0, false);
    CHECK(three.more >= one.more + 2.0);
    CHECK(three.steps > one.steps);
    // Once an object moves, the day that repeats is the first stage's, and not of the span.
    CHECK(days_of(SpanStart::periodic, 1.0, true).more == 1.0);
    CHECK(days_of(SpanStart::state, 2.0, false).repeated == 0.0);
}

TEST_CASE("smoke and textures cost in a plan by the pixels that they fill", "[scenes][plan]") {
    const auto plan_with = [](const std::string& tables) { return scene_with("", tables).plan; };
    const auto plume = [](double radius) {
        return fmt::format(
            "[[plume]]\nname = \"smoke\"\nplace_m = [-20.0, -20.0]\nheight_m = 30.0\nradius_m = "
            "{0}\ntop_radius_m = {0}\ntemperature_K = 300.0\nabsorption_per_m = 0.1\n",
            radius);
    };
    const Plan none = plan_with(""), thin = plan_with(plume(2.0)), wide = plan_with(plume(20.0));
    const auto more = [&](const Plan& plan, StageId stage) {
        return seconds_of(stage, plan) - seconds_of(stage, none);
    };
    for (const StageId stage : {StageId::views, StageId::frames}) {
        CHECK(more(thin, stage) > 0.0);
        // Ten times as wide: ten times as large from the side, a hundred times from above.
        CHECK(more(wide, stage) > 10.0 * more(thin, stage));
        CHECK(more(wide, stage) < 100.0 * more(thin, stage));
    }
    CHECK(wide.memory >= thin.memory);
    const Plan textured = plan_with(
        "[[texture]]\nname = \"worn\"\nstd = 0.02\ncorrelation_length_m = 12.0\n[[ground]]\nname = "
        "\"yard\"\nmaterial = \"asphalt\"\ntexture = \"worn\"\nrectangle_m = [-200.0, 0.0, 300.0, "
        "300.0, 45.0]\nlargest_edge_m = 60.0\n");
    CHECK(more(textured, StageId::views) > 0.0);
}

TEST_CASE("an uncertain value costs in a plan a view more, not a picture's planes",
          "[scenes][plan]") {
    const Plan none = scene_with("").plan, one = scene_with("", R"(
[[uncertain]]
key = "weather.changed.wind_factor"
one_sigma = 1.2
)")
                                                     .plan;
    // A scene of 3 MB, its facets, and 64 x 48 pixels.
    CHECK(one.memory - none.memory < 4e6 + 1300.0 * double(none.facets));
    CHECK(one.memory > none.memory);
}
