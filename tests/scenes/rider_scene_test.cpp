#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

// Observers that ride on objects: what they see of others, and of what they ride on.

using namespace diurna;
namespace fs = std::filesystem;

namespace {

/// The small scene with ways, crates and observers of one's own.
std::string scene_with(const std::string& more) {
    std::string text = with(small_scene(), "radius_m = 4000.0", "radius_m = 800.0");
    text.erase(text.find("[[observer]]"));
    return text + more;
}

Prepared prepared(const std::string& more) {
    const ScratchFolder folder("rider_scene");
    write_text(folder.path / "crate.obj", crate_mesh);
    write_text(folder.path / "scene.toml", scene_with(more));
    return prepare(read_scene(folder.path / "scene.toml"));
}

std::string a_crate(const std::string& name, const std::string& stands) {
    return "[[object]]\nname = \"" + name +
           "\"\nmesh = \"crate.obj\"\nup = \"z\"\nmaterial = \"painted_sheet\"\nlargest_edge_m = "
           "2.0\nstands = \"upright\"\n" +
           stands + "\n";
}

const std::string camera = R"(
horizontal_fov_deg = 60.0
width = 160
height = 120
bands = ["8-12"]
frames = ["2026-07-15T10:00:02-04:00", "2026-07-15T10:00:05-04:00", "2026-07-15T10:00:08-04:00"]
)";

/// One goes east at 10 m/s and turns north at its end, another south across its way.
const std::string two_go = R"(
[[trajectory]]
name = "east"
waypoints_m = [[-100.0, -200.0, 900.0], [0.0, -200.0, 900.0], [0.0, 0.0, 900.0]]
times_s = [0.0, 10.0, 30.0]
start = 2026-07-15T10:00:00-04:00
heights = "sea"
[[trajectory]]
name = "south"
waypoints_m = [[0.0, -170.0, 901.0], [0.0, -230.0, 901.0]]
times_s = [0.0, 15.0]
start = 2026-07-15T10:00:00-04:00
heights = "sea"
)" + a_crate("carrier", "trajectory = \"east\"") +
                           a_crate("other", "trajectory = \"south\"");

struct Box {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    void add(double x, double y) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
};

/// Of the pixels that see an object.
Box seen(const Frame& frame, float object) {
    Box box;
    const std::vector<float>& plane = frame["object"].pixel;
    for (std::size_t p = 0; p < plane.size(); ++p) {
        if (plane[p] != object) continue;
        box.add(double(p % 160), double(p / 160));
        box.add(double(p % 160 + 1), double(p / 160 + 1));
    }
    return box;
}

constexpr float carrier = 3.0f, other = 4.0f;  // ground, runway, hangar, and then these

}  // namespace

TEST_CASE("an attached observer sees other objects where they are and its own hood in one place",
          "[scenes][rider]") {
    const ScratchFolder folder("rider_pictures");
    write_text(folder.path / "crate.obj", crate_mesh);
    write_text(folder.path / "scene.toml",
               scene_with(two_go + "[[observer]]\nname = \"driver\"\non = \"carrier\"\n" +
                          "mount_m = [0.5, 1.0, 2.5]\nmount_deg = [0.0, -10.0, 0.0]\n" + camera));
    run_job(read_scene(folder.path / "scene.toml"), {.out = folder.path / "out", .settings = {}});
    const std::array<double, 3> seconds = {2.0, 5.0, 8.0};
    std::vector<std::vector<bool>> hood;
    for (const double t : seconds) {
        const Frame frame =
            read_exr(folder.path / "out/frames" /
                     ("driver_8-12_20260715T14000" + std::to_string(int(t)) + "Z.exr"));
        // The eye, 2.5 m over the carrier's foot, 1 m before its middle and 0.5 m to its right,
        // looks east; the corners of the other's box of 4 x 4 x 2 m, a metre higher, by the
        // pinhole's law.
        Box expected;
        const double focal = 80.0 / std::tan(M_PI / 6.0), pitch = -10.0 * M_PI / 180.0;
        for (const double dx : {-2.0, 2.0}) {
            for (const double dy : {-2.0, 2.0}) {
                for (const double dz : {0.0, 2.0}) {
                    const double ahead = dx - (-100.0 + 10.0 * t + 1.0);
                    const double right = -(-170.0 - 4.0 * t + dy - (-200.0 - 0.5));
                    const double up = 1.0 + dz - 2.5;
                    const double depth = ahead * std::cos(pitch) + up * std::sin(pitch);
                    const double above = -ahead * std::sin(pitch) + up * std::cos(pitch);
                    expected.add(80.0 + focal * right / depth, 60.0 - focal * above / depth);
                }
            }
        }
        const Box found = seen(frame, other);
        CAPTURE(t);
        // A pixel counts where its middle sees it.
        CHECK(found.left == Approx(expected.left).margin(0.51));
        CHECK(found.right == Approx(expected.right).margin(0.51));
        CHECK(found.top == Approx(expected.top).margin(0.51));
        CHECK(found.bottom == Approx(expected.bottom).margin(0.51));
        // The edge of its own lid is 1 m ahead and half a metre down.
        const Box own = seen(frame, carrier);
        CHECK(own.top == Approx(60.0 + focal * std::tan(std::atan(0.5) + pitch)).margin(0.51));
        const std::vector<float>& plane = frame["object"].pixel;
        std::vector<bool>& mask = hood.emplace_back();
        for (const float object : plane) mask.push_back(object == carrier);
        CHECK(mask == hood.front());
        CHECK(std::count(mask.begin(), mask.end(), true) > 500);
    }
}

TEST_CASE("an observer turns with the object that it is attached to", "[scenes][rider]") {
    const std::string late = with(camera, "10:00:08-04:00", "10:00:20-04:00");
    const Prepared scene =
        prepared(two_go + "[[observer]]\nname = \"driver\"\non = \"carrier\"\n" +
                 "mount_m = [1.0, 5.0, 3.0]\nmount_deg = [30.0, 0.0, 0.0]\nexposure_s = 0.01\n" +
                 late + "[[observer]]\nname = \"chaser\"\non = \"carrier\"\n" +
                 "mount_m = [0.0, -20.0, 5.0]\nlook_at = \"other\"\n" + late);
    const Sequence& driver = scene.sequences.at(0);
    CHECK(driver.at(0).azimuth_deg == Approx(120.0).margin(1e-6));
    CHECK(driver.at(0).position.x() == Approx(-80.0 + 5.0).margin(1e-6));
    CHECK(driver.at(0).position.y() == Approx(-200.0 - 1.0).margin(1e-6));
    CHECK(driver.at(0).velocity.x() == Approx(10.0).margin(1e-6));
    CHECK(driver.at(0).turning.norm() == Approx(0.0).margin(1e-9));
    // Round the corner: 10 s north of it.
    CHECK(driver.at(2).azimuth_deg == Approx(30.0).margin(1e-6));
    CHECK(driver.at(2).position.x() == Approx(1.0).margin(1e-6));
    CHECK(driver.at(2).position.y() == Approx(-100.0 + 5.0).margin(1e-6));
    // And the other one, at rest at [0, -230, 901] since 5 s, its middle a metre higher.
    const Observer& chaser = scene.sequences.at(1).at(2);
    CHECK(chaser.position.y() == Approx(-120.0).margin(1e-6));
    CHECK(chaser.azimuth_deg == Approx(180.0).margin(1e-6));
    const double earth = 6371000.0;  // the level falls away from the site's plane
    const double above = 905.0 - 902.0 + (230.0 * 230.0 - 100.0 * 100.0) / (2.0 * earth);
    CHECK(chaser.elevation_deg == Approx(-std::atan2(above, 110.0) * 180.0 / M_PI).margin(1e-4));
}

TEST_CASE("an observer on an object at rest is placed in its frame", "[scenes][rider]") {
    const Prepared scene =
        prepared(a_crate("tower", "place_m = [-50.0, -60.0]\nheading_deg = 30.0") +
                 "[[observer]]\nname = \"guard\"\non = \"tower\"\nmount_m = [1.0, 2.5, 4.0]\n"
                 "mount_deg = [-30.0, -10.0, 0.0]\n" +
                 camera);
    REQUIRE(scene.sequences.at(0).pose.size() == 1);
    const Observer& guard = scene.sequences.at(0).at(0);
    const double c = std::cos(M_PI / 6.0), s = 0.5;
    CHECK(guard.position.x() == Approx(-50.0 + c * 1.0 + s * 2.5).margin(1e-6));
    CHECK(guard.position.y() == Approx(-60.0 - s * 1.0 + c * 2.5).margin(1e-6));
    CHECK(std::remainder(guard.azimuth_deg, 360.0) == Approx(0.0).margin(1e-6));
    CHECK(guard.elevation_deg == Approx(-10.0).margin(1e-6));
    float lowest = 1e9f;
    for (const Eigen::Vector3f& v : scene.world.facets.vertex) {
        if ((v.head<2>() - Eigen::Vector2f(-50, -60)).norm() < 3.0f)
            lowest = std::min(lowest, v.z());
    }
    CHECK(guard.position.z() == Approx(double(lowest) + 4.0).margin(0.2));
}

TEST_CASE("an observer inside a moving object is reported, for the instants at which it is inside",
          "[scenes][rider][input]") {
    const std::string ride =
        "[[observer]]\nname = \"driver\"\non = \"carrier\"\nmount_deg = "
        "[0.0, 0.0, 0.0]\n" +
        camera;
    CHECK_THROWS_WITH(prepared(two_go + ride + "mount_m = [0.0, 0.0, 1.0]\n"),
                      Catch::Contains("scene.toml:") && Catch::Contains("observer.on") &&
                          Catch::Contains("inside \"carrier\", 1.0 m below its top"));
    CHECK_NOTHROW(prepared(two_go + ride + "mount_m = [0.0, 0.0, 2.5]\n"));
    const std::string road = R"([[trajectory]]
name = "road"
waypoints_m = [[-50.0, -50.0, 0.0], [10.0, -50.0, 0.0]]
times_s = [0.0, 60.0]
start = 2026-07-15T10:00:00-04:00
)" + a_crate("truck", "trajectory = \"road\"") +
                             "[[observer]]\nname = \"post\"\nplace_m = [-50.0, -50.0]\n"
                             "height_above_ground_m = 1.0\nazimuth_deg = 0.0\nelevation_deg = "
                             "0.0\nwidth = 8\nheight = 6\n";
    CHECK_NOTHROW(prepared(road + "frames = [\"2026-07-15T12:00:00-04:00\"]\n"));
    CHECK_THROWS_WITH(prepared(road + "frames = [\"2026-07-15T09:00:00-04:00\"]\n"),
                      Catch::Contains("observer.place_m") &&
                          Catch::Contains("at 2026-07-15T13:00:00Z") &&
                          Catch::Contains("inside \"truck\""));
    // Where it ends, at its end.
    CHECK_THROWS_WITH(prepared(with(road, "place_m = [-50.0", "place_m = [10.0") +
                               "frames = [\"2026-07-15T12:00:00-04:00\"]\n"),
                      Catch::Contains("inside \"truck\""));
}

TEST_CASE("what an attached observer cannot have is refused", "[scenes][rider][input]") {
    const std::string ride =
        "[[observer]]\nname = \"driver\"\non = \"carrier\"\nmount_m = [0.0, 0.0, 3.0]\n"
        "mount_deg = [0.0, 0.0, 0.0]\n" +
        camera;
    for (const std::string key : {"place_m = [0.0, 0.0]", "height_above_ground_m = 3.0",
                                  "trajectory = \"east\"", "velocity_m_s = [1.0, 0.0, 0.0]"}) {
        CHECK_THROWS_WITH(prepared(two_go + ride + key + "\n"),
                          Catch::Contains(key.substr(0, key.find(' '))));
    }
    CHECK_THROWS_WITH(prepared(two_go + with(ride, "on = \"carrier\"", "on = \"carier\"")),
                      Catch::Contains("carier") && Catch::Contains("carrier"));
    CHECK_THROWS_WITH(prepared(two_go + with(ride, "mount_m = [0.0, 0.0, 3.0]", "")),
                      Catch::Contains("mount_m"));
    CHECK_THROWS_WITH(prepared(two_go + with(ride, "on = \"carrier\"", "trajectory = \"east\"")),
                      Catch::Contains("mount_m"));
}
