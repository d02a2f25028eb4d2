#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "render/view/cast_view.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

// Objects that go along trajectories: where they are in the heat balance and in pictures, and that
// heat goes on through their moves.

using namespace diurna;

namespace {

/// The small scene with a box of 4 x 4 x 2 m on the grass, as `stands` says.
std::string scene_with(const std::string& stands) {
    std::string text = small_scene();
    text = with(text, "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]");
    text = with(text, "frame_every_s = 21600.0", "frames = [\"2026-07-15T12:00:00-04:00\"]");
    return text + crate_object + "stands = \"upright\"\n" + stands;
}

struct Solved {
    Prepared prepared;
    SpanResult result;

    /// Temperature of a surface at an instant [K].
    double at(std::size_t facet, const char* when) const {
        return result.temperature.interpolate(parse_instant(when))[facet];
    }
    /// The ground facet whose middle lies nearest to a place.
    std::size_t ground(double east, double north) const {
        const FacetSet& facets = prepared.world.facets;
        std::size_t nearest = 0;
        float least = 1e9f;
        for (std::size_t f = 0; f < prepared.world.ground_facets; ++f) {
            const float apart =
                (facets.centroid[f].head<2>() - Eigen::Vector2f(float(east), float(north))).norm();
            if (apart < least) least = apart, nearest = f;
        }
        return nearest;
    }
};

Solved solved(const std::string& stands) {
    const ScratchFolder folder("mover_scene");
    write_text(folder.path / "crate.obj", crate_mesh);
    write_text(folder.path / "scene.toml", scene_with(stands));
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(result)};
}

SolvedScene checked(const std::string& stands) {
    const ScratchFolder folder("mover_check");
    write_text(folder.path / "crate.obj", crate_mesh);
    write_text(folder.path / "scene.toml", scene_with(stands));
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    return solve_scene(Stages(prepared), silent, {.check_points = 48});
}

const std::string from_west_to_east = R"(trajectory = "road"
[[trajectory]]
name = "road"
waypoints_m = [[-50.0, -50.0, 0.0], [-50.0, -50.0, 0.0], [10.0, -50.0, 0.0]]
times_s = [0.0, 36000.0, 36060.0]
)";

}  // namespace

TEST_CASE("a trajectory that stays in one place changes nothing",
          "[scenes][mover][by_degenerate]") {
    const Solved stands = solved("place_m = [-50.0, -50.0]\nheading_deg = 90.0\n");
    // It goes a way of 2 cm at ten: what is solved again from there on is what it was, except for
    // what the rays of facets near the crate find, and a start whose day repeats without its trend.
    const Solved goes =
        solved(with(from_west_to_east, "[10.0, -50.0, 0.0]", "[-49.98, -50.0, 0.0]"));
    REQUIRE(goes.prepared.movement.stage.size() == 2);
    const FacetSet& facets = stands.prepared.world.facets;
    REQUIRE(facets.size() == goes.prepared.world.facets.size());
    REQUIRE(stands.result.temperature.instant == goes.result.temperature.instant);
    double far = 0.0, near = 0.0, count = 0.0, worst_far = 0.0, near_count = 0.0;
    for (std::size_t i = 0; i < stands.result.temperature.instant.size(); ++i) {
        for (std::size_t f = 0; f < stands.prepared.world.ground_facets; ++f) {
            const double apart = double(stands.result.temperature.at(i)[f]) -
                                 double(goes.result.temperature.at(i)[f]);
            const bool is_far =
                (facets.centroid[f].head<2>() - Eigen::Vector2f(-50, -50)).norm() > 8.0f;
            (is_far ? far : near) += apart * apart;
            (is_far ? count : near_count) += 1.0;
            if (is_far) worst_far = std::max(worst_far, std::abs(apart));
        }
    }
    CAPTURE(worst_far);
    CHECK(std::sqrt(far / count) < 0.02);
    CHECK(std::sqrt(near / near_count) < 0.25);
}

// The same places of the same pictures, in one stage and in two that are alike.
TEST_CASE("places are checked where an object moves",
          "[scenes][mover][check_points][by_degenerate]") {
    const std::string rests = "place_m = [-50.0, -50.0]\nheading_deg = 90.0\n";
    const std::string moves = with(from_west_to_east, "[10.0, -50.0, 0.0]", "[-49.98, -50.0, 0.0]");
    const SolvedScene still = checked(rests), goes = checked(moves);
    CAPTURE(still.check.rms, goes.check.rms, still.check.worst_at, goes.check.worst_at);
    CHECK(still.places > 20);
    CHECK(goes.places + goes.unchecked == still.places + still.unchecked);
    CHECK(goes.check.rms > 0.0);
    CHECK(goes.check.rms == Approx(still.check.rms).epsilon(0.1));
}

TEST_CASE("what drives off leaves its scar and its shadow comes along", "[scenes][mover]") {
    const Solved west = solved("place_m = [-50.0, -50.0]\nheading_deg = 90.0\n");
    const Solved east = solved("place_m = [10.0, -50.0]\nheading_deg = 90.0\n");
    const Solved goes = solved(from_west_to_east);
    // The asphalt below the crate, and in the open where none stands.
    const auto mean = [](const Solved& of, double x, const char* when) {
        const FacetSet& facets = of.prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < of.prepared.world.ground_facets; ++f) {
            const Eigen::Vector2f place = facets.centroid[f].head<2>();
            if ((place - Eigen::Vector2f(float(x), -50.0f)).norm() > 1.6f) continue;
            sum += double(facets.area[f]) * of.at(f, when);
            area += double(facets.area[f]);
        }
        // In the open ground is coarse.
        return area > 0.0 ? sum / area : of.at(of.ground(x, -50.0), when);
    };
    const double left = -50.0, arrived = 10.0;
    const char* const nine = "2026-07-15T13:00:00Z";
    const char* const half_past_ten = "2026-07-15T14:30:00Z";
    const char* const four = "2026-07-15T20:00:00Z";
    // Before the move all is as where it stands, and where it will stand as in the open.
    CHECK(mean(goes, left, nine) == Approx(mean(west, left, nine)).margin(0.3));
    CHECK(mean(goes, arrived, nine) == Approx(mean(west, arrived, nine)).margin(0.3));
    // As it departs too: nothing shades the place yet where it will stand, nor warms it.
    const char* const ten = "2026-07-15T14:00:00Z";
    CHECK(mean(goes, left, ten) == Approx(mean(west, left, ten)).margin(0.3));
    CHECK(mean(goes, arrived, ten) == Approx(mean(west, arrived, ten)).margin(0.3));
    // Half an hour behind it the place is colder than open ground by a part of what it was below
    // the crate. A half-space that a step of flux warms has come nearer by 2 q sqrt(t / pi) / e:
    // the open asphalt has risen so since the sun met it, some five hours; of that, sqrt(0.5 / 5)
    // is 0.3. By four it is sqrt(6) of sqrt(11) hours: 0.26 are left, less what the film evens out.
    const auto scar = [&](const char* when) {
        const double open = mean(east, left, when);
        return (open - mean(goes, left, when)) / (open - mean(west, left, when));
    };
    CAPTURE(scar(nine), scar(half_past_ten), scar(four));
    CHECK(scar(nine) == Approx(1.0).margin(0.05));
    CHECK(scar(half_past_ten) > 0.35);
    CHECK(scar(half_past_ten) < 0.75);
    CHECK(scar(four) < 0.26);
    CHECK(scar(four) > 0.02);
    // And where it stands now the ground has gone from the open's to what is covered all day.
    const double open = mean(west, arrived, four), covered = mean(east, arrived, four);
    CHECK(mean(goes, arrived, four) < 0.5 * (open + covered));
    CHECK(mean(goes, arrived, four) > covered - 0.2);
    // Its sheets, thin, are as those of the crate that always stood there.
    const auto top = [&](const Solved& of) {
        const FacetSet& facets = of.prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = of.prepared.world.ground_facets; f < facets.size(); ++f) {
            if (facets.object[f] != ObjectId{3} || facets.normal[f].z() < 0.9f) continue;
            sum += double(facets.area[f]) * of.at(f, four);
            area += double(facets.area[f]);
        }
        CHECK(area == Approx(16.0).epsilon(1e-4));
        return sum / area;
    };
    CHECK(top(goes) == Approx(top(east)).margin(0.3));
}

TEST_CASE("a picture shows an object where its trajectory has led it", "[scenes][mover]") {
    const ScratchFolder folder("mover_frames");
    write_text(folder.path / "crate.obj", crate_mesh);
    const std::string text = with(scene_with(from_west_to_east), "look_at_m = [0.0, 0.0]",
                                  "look_at = \"crate\"\nframes = [\"2026-07-15T09:59:00-04:00\", "
                                  "\"2026-07-15T10:00:00-04:00\", "
                                  "\"2026-07-15T10:00:15-04:00\", \"2026-07-15T10:00:45-04:00\", "
                                  "\"2026-07-15T11:00:00-04:00\"]");
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Sequence& eye = prepared.sequences.at(0);
    REQUIRE(eye.pose.size() == 5);
    // The camera turns after it: 1 m/s east from -50, 50 m north of the camera.
    const std::array<double, 5> east = {-50.0, -50.0, -35.0, -5.0, 10.0};
    for (std::size_t i = 0; i < 5; ++i) {
        const double azimuth = std::atan2(east[i] + 100.0, 50.0) * 180.0 / 3.14159265358979;
        CAPTURE(i);
        CHECK(std::remainder(eye.at(i).azimuth_deg - azimuth, 360.0) == Approx(0.0).margin(0.02));
        const MoverPoses& poses = prepared.movement.poses_at(eye.frame[i]);
        CHECK(poses.at(0).translation().x() == Approx(east[i]).margin(1e-6));
        CHECK(prepared.movement.is_under_way(eye.frame[i]) == (i >= 2 && i <= 3));
        // Its front looks along the way, before it sets out too.
        CHECK(poses.at(0).linear()(0, 1) == Approx(1.0).margin(1e-3));
        const World there = moved(prepared.world, poses);
        Eigen::AlignedBox3d box;
        for (std::size_t f = there.ground_facets; f < there.facets.size(); ++f) {
            if (there.facets.object[f] != there.movers.at(0).id) continue;
            for (const std::uint32_t v : there.facets.corner[f]) {
                box.extend(there.facets.vertex[v].cast<double>());
            }
        }
        CHECK(box.center().x() == Approx(east[i]).margin(1e-3));
        CHECK(box.sizes().z() == Approx(2.0).margin(1e-3));
    }
    // At ten, as it sets out, the heat balance still has it where it was. The middle of the move,
    // half past a minute after ten, on the nearest step of twenty minutes.
    REQUIRE(prepared.movement.stage.size() == 2);
    CHECK(format_instant(prepared.movement.stage[1]) == "2026-07-15T14:00:00Z");
}

TEST_CASE("an object that departs at the span's start was at that place before",
          "[scenes][mover]") {
    const ScratchFolder folder("mover_start");
    write_text(folder.path / "crate.obj", crate_mesh);
    const std::string leaves = with(from_west_to_east, "36000.0, 36060.0", "1.0, 61.0");
    write_text(folder.path / "scene.toml", scene_with(leaves));
    const Movement movement = prepare(read_scene(folder.path / "scene.toml")).movement;
    REQUIRE(movement.stage.size() == 2);
    CHECK(format_instant(movement.stage[1]) == "2026-07-15T04:20:00Z");
    CHECK(movement.at_stage[0].at(0).translation().x() == Approx(-50.0));
    CHECK(movement.at_stage[1].at(0).translation().x() == Approx(10.0));
    CHECK(movement.stage_of(movement.stage[1]) == 1);  // there it has arrived
}

TEST_CASE("a day divided during a move continues as the undivided one", "[scenes][mover]") {
    const ScratchFolder folder("mover_state");
    write_text(folder.path / "crate.obj", crate_mesh);
    const auto run = [&](const std::string& name, const std::string& time) {
        std::string text =
            with(scene_with(from_west_to_east), "frames = [\"2026-07-15T12:00:00-04:00\"]\n", time);
        text = with(text, "start = 2026-07-15T00:00:00-04:00\n", "");
        text = with(text, "times_s = [0.0, 36000.0, 36060.0]",
                    "times_s = [0.0, 36000.0, 36060.0]\nstart = 2026-07-15T00:00:00-04:00");
        write_text(folder.path / (name + ".toml"), text + "[output]\nstate = true\n");
        const Prepared prepared = prepare(read_scene(folder.path / (name + ".toml")));
        Progress silent(ProgressStyle::silent);
        SpanResult result = solve_scene(Stages(prepared), silent);
        std::filesystem::create_directories(folder.path / name);
        write_heat(prepared, run_inputs(prepared.scene), result,
                   folder.path / name / "temperatures.nc");
        return result;
    };
    const auto span = [](const char* start, const char* end, const std::string& more) {
        return std::string("start = ") + start + "\nend = " + end + "\nframes = [\"" + end +
               "\"]\n" + more;
    };
    const char* const midnight = "2026-07-15T00:00:00-04:00";
    const char* const noon = "2026-07-15T12:00:00-04:00";
    const char* const four = "2026-07-15T16:00:00-04:00";
    const SpanResult whole = run("whole", span(midnight, four, "spin_up = \"periodic\"\n"));
    run("morning", span(midnight, noon, "spin_up = \"periodic\"\n"));
    const SpanResult on = run("on", span(noon, four, "state = \"morning/state.nc\"\n"));
    double square = 0.0;
    const std::vector<float> a = whole.temperature.interpolate(parse_instant(four)),
                             b = on.temperature.interpolate(parse_instant(four));
    REQUIRE(a.size() == b.size());
    for (std::size_t f = 0; f < a.size(); ++f) square += std::pow(double(a[f]) - double(b[f]), 2);
    CHECK(std::sqrt(square / double(a.size())) < 0.02);
    CHECK_THROWS_WITH(run("steady", span(midnight, four, "spin_up = \"steady\"\n")),
                      Catch::Contains("spin_up") && Catch::Contains("steady"));
}

TEST_CASE(
    "an open shutter smears a moving object, or one at rest if the camera follows the moving one",
    "[scenes][mover][motion]") {
    const ScratchFolder folder("mover_blur");
    write_text(folder.path / "crate.obj", crate_mesh);
    // 1 m/s to the east under a camera that looks straight down, 0.1 m a pixel, for a second.
    const std::string above =
        "place_m = [-20.0, -50.0]\nprojection = \"orthographic\"\npicture_width_m = 9.6\n"
        "exposure_s = 1.0\nframes = [\"2026-07-15T10:00:30-04:00\"]\n";
    std::string text = scene_with(from_west_to_east);
    text = with(text, "place_m = [-100.0, -100.0]\n", above);
    text = with(text, "horizontal_fov_deg = 24.0\n", "");
    text = with(text, "width = 64\n", "width = 96\n");
    const auto seen = [&](const std::string& pointed) {
        write_text(folder.path / "scene.toml", with(text, "look_at_m = [0.0, 0.0]", pointed));
        const Prepared scene = prepare(read_scene(folder.path / "scene.toml"));
        const Observer& eye = scene.sequences.at(0).at(0);
        const Instant when = scene.sequences[0].frame.at(0);
        REQUIRE(scene.movement.moves_at(when));
        CHECK(scene.movement.motions_at(when).at(0).velocity.x() == Approx(1.0).margin(1e-6));
        const Prepared there = moving(scene, scene.movement.poses_at(when),
                                      scene.movement.motions_at(when), eye.reach());
        const View view = cast_view(there.rays, there.world.facets, eye, {.samples = 1024});
        std::vector<double> share(96, 0.0);
        for (std::size_t p = std::size_t{96} * 24; p < std::size_t{96} * 25; ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (there.world.facets.object[index(view.surface[s.target])] == ObjectId{3}) {
                    share[p % 96] += double{s.weight};
                }
            }
        }
        return share;
    };
    // From -2.5 to -1.5 m about its middle the share rises evenly, and falls likewise.
    const std::vector<double> still = seen("azimuth_deg = 0.0\nelevation_deg = -90.0");
    for (std::size_t column = 0; column < 96; ++column) {
        const double east = 0.1 * (double(column) - 47.5);
        CAPTURE(column);
        CHECK(still[column] == Approx(std::clamp(2.5 - std::abs(east), 0.0, 1.0)).margin(0.015));
    }
    // A lens that turns after it from 450 m up and 450 m south: 0.1 m a pixel there.
    text = with(text, "projection = \"orthographic\"\npicture_width_m = 9.6\n",
                "horizontal_fov_deg = 0.8643\n");
    text = with(text, "place_m = [-20.0, -50.0]", "place_m = [-20.0, -500.0]");
    const std::vector<double> along = seen("look_at = \"crate\"");
    std::size_t whole = 0, partly = 0;
    for (const double share : along) {
        whole += share > 0.99;
        partly += share > 0.01 && share < 0.99;
    }
    CHECK(double(whole) == Approx(40.0).margin(2.0));
    CHECK(partly <= 4);
}

TEST_CASE("what a moving object cannot have is refused", "[scenes][mover][input]") {
    for (const std::string key : {"place_m = [0.0, 0.0]", "heading_deg = 10.0",
                                  "height_above_ground_m = 1.0", "airspeed_m_s = 20.0"}) {
        CHECK_THROWS_WITH(solved(key + "\n" + from_west_to_east),
                          Catch::Contains(key.substr(0, key.find(' '))));
    }
    CHECK_THROWS_WITH(
        solved("trajectory = \"rode\"\n" + from_west_to_east.substr(from_west_to_east.find('['))),
        Catch::Contains("rode") && Catch::Contains("road"));
}
