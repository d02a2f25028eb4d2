#include "scenes/job/world/stance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "tests/support/slope_scene.hpp"

using namespace diurna;
using namespace slope_scene;

// Heights and angles are those of the plane by which the ground is made.

namespace {

/// Highest and lowest of an object's corners above a ground of a formula [m], of those of its
/// underside.
struct Stood {
    double lowest = 1e9, highest = -1e9;
};
Stood stood(const World& world, const std::string& name, const Ground& ground) {
    const auto id = ObjectId(std::find(world.objects.begin(), world.objects.end(), name) -
                             world.objects.begin());
    Stood found;
    for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
        if (world.facets.object[f] != id || world.facets.normal[f].z() > -0.6f) continue;
        for (const std::uint32_t v : world.facets.corner[f]) {
            const Eigen::Vector3f& p = world.facets.vertex[v];
            const double height =
                double(p.z()) + world.site.height - ground(double(p.x()), double(p.y()));
            found.lowest = std::min(found.lowest, height);
            found.highest = std::max(found.highest, height);
        }
    }
    return found;
}

Prepared prepared(const ScratchFolder& folder, const Ground& ground, const std::string& objects) {
    return prepare(read_scene(written(folder.path, ground, objects)));
}

std::string crate(const std::string& rest) { return object("crate", rest); }

std::vector<std::string> warnings(const Prepared& scene) { return as_lines(stand_warnings(scene)); }

}  // namespace

TEST_CASE("a vehicle stands on a slope with all its corners, whichever way it heads",
          "[scenes][stance]") {
    const ScratchFolder folder("stance");
    const double slope = GENERATE(8.0, 25.0), towards = GENERATE(0.0, 90.0, 210.0),
                 heading = GENERATE(0.0, 130.0);
    CAPTURE(slope, towards, heading);
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const Ground ground = plane(slope, towards);
    const Prepared scene = prepared(
        folder, ground, crate(fmt::format("place_m = [4.0, -3.0]\nheading_deg = {}", heading)));
    const Stood found = stood(scene.world, "crate", ground);
    CHECK(std::abs(found.lowest) < 0.02);
    CHECK(std::abs(found.highest) < 0.02);
    // Its upward axis is the plane's normal, its front in the vertical plane of its heading.
    const Eigen::Isometry3d pose = stance_in(scene.scene.terrain.objects[0].placing).pose();
    const double fall = std::tan(radians(slope)), a = radians(towards);
    const Eigen::Vector3d normal =
        Eigen::Vector3d(fall * std::sin(a), fall * std::cos(a), 1.0).normalized();
    CHECK((pose.linear().col(2) - normal).norm() < 2e-3);
    const Eigen::Vector3d front = pose.linear().col(1);
    CHECK(std::remainder(degrees(std::atan2(front.x(), front.y())) - heading, 360.0) ==
          Approx(0.0).margin(1e-6));
    CHECK(warnings(scene).empty());
}

TEST_CASE("in a hollow and on a crest an object stands on its corners, not on the middle",
          "[scenes][stance]") {
    const ScratchFolder folder("stance_bent");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const double bend = GENERATE(0.3, -0.3);  // rises to both sides, or falls
    const Ground ground = [bend](double east, double) {
        return 500.0 + bend * std::abs(east - 1.0);
    };
    const Prepared scene = prepared(folder, ground, crate("place_m = [1.0, 0.0]"));
    // All four corners are 1.5 m from the bend: the ground there is level, 0.45 m off the middle's.
    const Stood found = stood(scene.world, "crate", ground);
    CHECK(std::abs(found.lowest) < 0.05);
    CHECK(std::abs(found.highest) < 0.05);
    CHECK(warnings(scene).empty());
}

TEST_CASE("on level ground an object stands as without a slope, bit by bit", "[scenes][stance]") {
    const ScratchFolder folder("stance_level");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const auto vertices = [&](const std::string& stands) {
        return prepared(folder, plane(0.0, 0.0),
                        crate("place_m = [14.0, -23.0]\nheading_deg = 33.0\n" + stands))
            .world.facets.vertex;
    };
    const auto by_itself = vertices(""), upright = vertices("stands = \"upright\"");
    REQUIRE(by_itself.size() == upright.size());
    CHECK(std::equal(by_itself.begin(), by_itself.end(), upright.begin()));
}

TEST_CASE("an object upright on a slope raises a warning with its depth and its gap",
          "[scenes][stance][warnings]") {
    const ScratchFolder folder("stance_upright");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const Prepared scene =
        prepared(folder, plane(25.0, 0.0), crate("place_m = [4.0, -3.0]\nstands = \"upright\""));
    // 3 m along the fall of 25 degrees: 1.40 m; a hundredth of it is skipped at the corners.
    const auto lines = warnings(scene);
    REQUIRE(lines.size() == 1);
    CAPTURE(lines[0]);
    double deep = 0.0, high = 0.0;
    const auto number = [&](const std::string& before) {
        return std::stod(lines[0].substr(lines[0].find(before) + before.size()));
    };
    deep = number("buried up to ");
    high = number("float up to ");
    CHECK(deep == Approx(1.399).epsilon(0.03));
    CHECK(high == Approx(1.399).epsilon(0.03));
}

TEST_CASE("a mast stands upright by itself, and angles may be given", "[scenes][stance]") {
    const ScratchFolder folder("stance_mast");
    write_text(folder.path / "mast.obj", box(0.4, 0.4, 8.0));
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const Ground ground = plane(20.0, 90.0);
    const Prepared scene =
        prepared(folder, ground,
                 object("mast", "place_m = [-8.0, 5.0]") +
                     crate("place_m = [4.0, -3.0]\npitch_deg = 0.0\nroll_deg = 20.0"));
    CHECK(scene.scene.terrain.objects[0].placing.pitch_deg == 0.0);
    CHECK(scene.scene.terrain.objects[0].placing.roll_deg == 0.0);
    // The plane falls to the east, on the right of what heads north.
    const Stood found = stood(scene.world, "crate", ground);
    CHECK(std::abs(found.lowest) < 0.02);
    CHECK(std::abs(found.highest) < 0.02);
    CHECK(warnings(scene).empty());
}

TEST_CASE(
    "given angles turn an object about the middle of its base, and what is in the ground is "
    "reported",
    "[scenes][stance][warnings]") {
    const ScratchFolder folder("stance_turned");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    struct Turned {
        double pitch_deg, roll_deg, height;
        double depth;  // [m] of its lowest point, by the sides of the box
    };
    const double pitched = 3.0 * std::sin(radians(25.0));
    const auto [pitch_deg, roll_deg, height, depth] =
        GENERATE_COPY(Turned{25.0, 0.0, 0.0, pitched}, Turned{25.0, 0.0, pitched, 0.0},
                      Turned{0.0, 180.0, 0.0, 2.0}, Turned{0.0, 180.0, 2.0, 0.0},
                      Turned{0.0, 90.0, 0.0, 1.5}, Turned{0.0, 90.0, -0.5, 2.0});
    CAPTURE(pitch_deg, roll_deg, height);
    const Prepared scene =
        prepared(folder, plane(0.0, 0.0),
                 crate(fmt::format("place_m = [4.0, -3.0]\nheading_deg = 30.0\npitch_deg = {}\n"
                                   "roll_deg = {}\nheight_above_ground_m = {}",
                                   pitch_deg, roll_deg, height)));
    const Eigen::Vector3d base = scene.scene.terrain.objects[0].placing.base;
    CHECK((base - Eigen::Vector3d(4.0, -3.0, height)).norm() < 0.01);
    const auto lines = warnings(scene);
    REQUIRE(lines.size() == (depth > 0.0 ? 1 : 0));
    if (lines.empty()) return;
    const auto number = [&](const std::string& before) {
        return std::stod(lines[0].substr(lines[0].find(before) + before.size()));
    };
    CAPTURE(lines[0]);
    CHECK(number("buried up to ") == Approx(depth).epsilon(0.03));
    CHECK(number("increase its height by ") == Approx(depth + std::min(0.0, height)).epsilon(0.03));
}

TEST_CASE("a model of a building stands upright, one of a vehicle on the slope",
          "[scenes][stance]") {
    const ScratchFolder folder("stance_models");
    const auto model = [](const std::string& name, const std::string& place) {
        return "[[object]]\nname = \"" + name + "\"\nmodel = \"" + name +
               "\"\ndetail = \"low\"\nground_edge_m = 5.0\nplace_m = " + place + "\n";
    };
    const Prepared scene =
        prepared(folder, plane(12.0, 45.0),
                 model("house", "[-15.0, 12.0]") + model("tracked_vehicle", "[12.0, -12.0]"));
    const auto& objects = scene.scene.terrain.objects;
    CHECK(objects[0].placing.roll_deg == 0.0);
    CHECK(std::hypot(objects[1].placing.roll_deg, objects[1].placing.pitch_deg) ==
          Approx(12.0).margin(0.5));
}

TEST_CASE("along a trajectory an object leans as the ground does", "[scenes][stance]") {
    const ScratchFolder folder("stance_way");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    // Level to the west, rising to the east by 15 degrees.
    const double rise = std::tan(radians(15.0));
    const Ground ground = [&](double east, double) { return 500.0 + rise * std::max(0.0, east); };
    const auto file = written(
        folder.path, ground,
        crate("trajectory = \"road\"") +
            "[[trajectory]]\nname = \"road\"\nwaypoints_m = [[-40.0, 2.0, 0.0], [40.0, 2.0, "
            "0.0]]\ntimes_s = [0.0, 3600.0]\n");
    std::string text = read_text(file);
    const std::string steady = "spin_up = \"steady\"";
    REQUIRE(text.find(steady) != std::string::npos);  // which moving objects do not have
    write_text(file, text.replace(text.find(steady), steady.size(), "spin_up = \"periodic\""));
    const Prepared scene = prepare(read_scene(file));
    // At the end of the hour at 40 m east, its front up the slope.
    const auto& end = scene.movement.poses_at(scene.scene.observers[0].frames[0]).at(0);
    const Eigen::Vector3d front = end.linear().col(1);
    CHECK(degrees(std::asin(front.z())) == Approx(15.0).margin(0.1));
    CHECK(std::abs(scene.world.movers[0].start.linear().col(1).z()) < 1e-6);
    CHECK(warnings(scene).empty());
}

TEST_CASE("copies lean each by its own ground", "[scenes][stance][copies]") {
    const ScratchFolder folder("stance_copies");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const double rise = std::tan(radians(15.0));
    const Ground ground = [&](double east, double) { return 500.0 + rise * std::abs(east); };
    const Prepared scene =
        prepared(folder, ground, crate("copies = [[-20.0, 0.0, 90.0], [20.0, 0.0, 90.0]]"));
    CHECK(scene.scene.terrain.objects[0].placing.pitch_deg == Approx(-15.0).margin(0.1));
    CHECK(scene.scene.terrain.objects[1].placing.pitch_deg == Approx(15.0).margin(0.1));
    CHECK(scene.world.copies.size() == 0);  // the sun falls on the one and not on the other
    CHECK(warnings(scene).empty());
}

TEST_CASE("stands and angles that contradict one another are refused", "[scenes][stance]") {
    const ScratchFolder folder("stance_mistakes");
    write_text(folder.path / "crate.obj", box(3.0, 6.0, 2.0));
    const auto mistake = [&](const std::string& rest) {
        try {
            read_scene(
                written(folder.path, plane(5.0, 0.0), crate("place_m = [0.0, 0.0]\n" + rest)));
        } catch (const InputError& error) {
            return error.mistakes().front().line();
        }
        return std::string();
    };
    CHECK(mistake("stands = \"on_slope\"\npitch_deg = 3.0").find("object.stands") !=
          std::string::npos);
    CHECK(mistake("stands = \"on_slope\"\nheight_above_sea_m = 503.0").find("object.stands") !=
          std::string::npos);
    CHECK(mistake("pitch_deg = 91.0").find("pitch_deg") != std::string::npos);
}
