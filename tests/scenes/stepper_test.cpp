#include "scenes/run/stepper.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/run/heat.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// A box of thin sheet on a plain part of the small scene, with a way as told.
Scene crate_scene(const ScratchFolder& folder, const std::string& way) {
    write_text(folder.path / "crate.obj", R"(v -2 -2 0
v 2 -2 0
v 2 2 0
v -2 2 0
v -2 -2 2
v 2 -2 2
v 2 2 2
v -2 2 2
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)");
    std::string text = small_scene();
    text = with(text, "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [-100.0, -100.0]");
    text = with(text, "height_above_ground_m = 450.0", "height_above_ground_m = 30.0");
    text = with(text, "look_at_m = [0.0, 0.0]", "look_at_m = [-50.0, -50.0]");
    write_text(folder.path / "scene.toml", text + R"(
[[object]]
name = "crate"
mesh = "crate.obj"
up = "z"
material = "painted_sheet"
largest_edge_m = 2.0
trajectory = "road"
[[trajectory]]
name = "road"
)" + way);
    return read_scene(folder.path / "scene.toml");
}

const std::string goes_at_ten =
    R"(waypoints_m = [[-50.0, -50.0, 0.0], [-50.0, -50.0, 0.0], [10.0, -50.0, 0.0], [10.0, -50.0, 0.0]]
times_s = [0.0, 36000.0, 36060.0, 86400.0]
)";
/// The same way, and so the same fine ground along it, days behind the span.
const std::string stays = goes_at_ten + "start = 2026-07-18T00:00:00-04:00\n";

Instant clock(const char* at) { return parse_instant(std::string("2026-07-15T") + at + "-04:00"); }

}  // namespace

TEST_CASE("a program that does what a trajectory does finds what a run finds",
          "[scenes][stepper]") {
    const ScratchFolder folder("stepper");
    const Prepared prepared = prepare(crate_scene(folder, goes_at_ten));
    Progress silent(ProgressStyle::silent);
    const SpanResult run = solve_scene(Stages(prepared), silent);

    const ScratchFolder other("stepper_other");
    Stepper scene(crate_scene(other, stays));
    REQUIRE(scene.prepared().world.surfaces().size() == run.temperature.facets);
    const auto worst = [&](const char* at) {
        scene.advance(clock(at));
        const std::vector<float> found = scene.temperature();
        const std::vector<float> expected = run.temperature.interpolate(clock(at));
        double sum = 0.0;
        for (std::size_t f = 0; f < found.size(); ++f) {
            sum += std::pow(double{found[f]} - double{expected[f]}, 2);
        }
        return std::sqrt(sum / double(found.size()));
    };
    // Kept instants of both: hours and half hours lie on steps of 20 minutes or between two.
    CHECK(worst("00:00:00") < 0.01);
    CHECK(worst("06:00:00") < 0.01);
    CHECK(worst("09:00:00") < 0.01);
    // It goes at ten for a minute: the nearest step to its middle is ten o'clock's.
    scene.advance(clock("10:00:30"));
    Eigen::Isometry3d there = scene.pose("crate");
    there.translation().x() += 60.0;
    scene.put("crate", {10.0, -50.0}, 90.0);
    CHECK((scene.pose("crate").translation() - there.translation()).head<2>().norm() < 1e-3);
    CHECK(worst("11:00:00") < 0.02);
    CHECK(worst("16:00:00") < 0.02);
    CHECK(worst("22:00:00") < 0.02);
}

TEST_CASE("pictures cost no solve, and show what was put where", "[scenes][stepper]") {
    const ScratchFolder folder("stepper_pictures");
    Stepper scene(crate_scene(folder, stays));
    scene.advance(clock("11:00:00"));
    const int solved = scene.steps_solved();
    Observer eye = scene.observer("east");
    const auto crate_pixels = [&](const Picture& picture) {
        double column = 0.0, count = 0.0;
        const auto& object = picture.frame["object"].pixel;
        for (std::size_t p = 0; p < object.size(); ++p) {
            if (object[p] < 3.0f) continue;
            column += double(p % std::size_t(picture.frame.width)) + 0.5;
            count += 1.0;
        }
        return std::pair{count, column / std::max(1.0, count)};
    };
    const auto [count, column] = crate_pixels(scene.picture("east", eye));
    REQUIRE(count > 4.0);
    // 10 m to the right of the line of sight (which runs north-east), 71 m away: by tan.
    Eigen::Isometry3d pose = scene.pose("crate");
    pose.translation() += Eigen::Vector3d(10.0, -10.0, 0.0) / std::sqrt(2.0);
    scene.put("crate", pose);
    const auto [still, aside] = crate_pixels(scene.picture("east", eye));
    CHECK(still > 4.0);
    const double range = (pose.translation() - eye.position).norm();
    const double focal = 32.0 / std::tan(12.0 * 3.14159265358979 / 180.0);
    CHECK(aside - column == Approx(focal * 10.0 / range).margin(1.5));
    CHECK(scene.steps_solved() == solved);
    // The same from there again, to the bit, on one thread.
    const Picture two = scene.picture("east", eye);
    set_thread_count(1);
    const Picture one = scene.picture("east", eye);
    set_thread_count(0);
    CHECK(one.frame["radiance.8-12"].pixel == two.frame["radiance.8-12"].pixel);
}

TEST_CASE("what a stepper cannot do is told", "[scenes][stepper]") {
    const ScratchFolder folder("stepper_mistakes");
    Stepper scene(crate_scene(folder, stays));
    using Catch::Contains;
    CHECK_THROWS_WITH(scene.put("crete", Eigen::Isometry3d::Identity()),
                      Contains("crete") && Contains("did you mean 'crate'"));
    CHECK_THROWS_WITH(scene.put("crate", {1e6, 0.0}, 0.0), Contains("crate"));
    CHECK_THROWS_WITH(scene.observer("west"), Contains("no observer \"west\""));
    CHECK_THROWS_WITH(scene.advance(clock("00:00:00") - std::chrono::hours(1)),
                      Contains("before now"));
    CHECK_THROWS_WITH(scene.advance(clock("23:59:59") + std::chrono::hours(1)),
                      Contains("span's end"));
    CHECK(scene.now() == clock("00:00:00"));
}
