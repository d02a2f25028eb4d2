#include <Eigen/Geometry>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/place_in_picture.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

// Observers that go along trajectories: where they are, what they look at, and that a picture alone
// is what it is among others.

using namespace diurna;
namespace fs = std::filesystem;

namespace {

/// The small scene with ways and observers of one's own.
std::string scene_with(const std::string& ways_and_observers) {
    std::string text = small_scene();
    text.erase(text.find("[[observer]]"));
    return text + ways_and_observers;
}

Prepared prepared(const std::string& ways_and_observers, const std::string& csv = "") {
    const ScratchFolder folder("trajectory_scene");
    write_text(folder.path / "scene.toml", scene_with(ways_and_observers));
    if (!csv.empty()) write_text(folder.path / "way.csv", csv);
    return prepare(read_scene(folder.path / "scene.toml"));
}

const std::string camera = R"(
horizontal_fov_deg = 30.0
width = 64
height = 48
bands = ["8-12"]
)";

const std::string approach = R"(
[[trajectory]]
name = "approach"
waypoints_m = [[-2000.0, -2000.0, 900.0], [0.0, 0.0, 500.0]]
times_s = [0.0, 40.0]
heights = "sea"
start = 2026-07-15T12:05:00-04:00
[[observer]]
name = "nose"
trajectory = "approach"
frame_every_s = 10.0
)";

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("an observer follows its trajectory, at heights above the sea", "[scenes][trajectory]") {
    const Prepared scene = prepared(approach + "look_at = \"hangar\"\n" + camera);
    const Sequence& nose = scene.sequences.at(0);
    REQUIRE(nose.frame.size() == 4);
    CHECK(format_instant(nose.frame[3]) == "2026-07-15T16:05:30Z");
    const Site& site = scene.world.site;
    // The raster's heights are the ellipsoid's here: the sea lies where the site's height says.
    const double geoid = site.height - scene.world.sea_level_height;
    for (std::size_t i = 0; i < 4; ++i) {
        const Observer& pose = nose.at(i);
        const double gone = double(i) / 4.0;
        CHECK(pose.position.x() == Approx(-2000.0 * (1.0 - gone)).margin(1e-6));
        CHECK(pose.position.y() == Approx(-2000.0 * (1.0 - gone)).margin(1e-6));
        // GeographicLib's ellipsoid against the program's level surface: 0.1 mm at 3 km.
        CHECK(to_geodetic(site, pose.position).height - geoid ==
              Approx(900.0 - 400.0 * gone).margin(5e-3));
        // The hangar: 12 m high on a plan of 60 x 40 m about [53, -88.4]; its middle is the
        // picture's.
        Eigen::AlignedBox3d hangar;
        const FacetSet& facets = scene.world.facets;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (facets.object[f] != ObjectId{2}) continue;
            for (const std::uint32_t corner : facets.corner[f]) {
                hangar.extend(facets.vertex[corner].cast<double>());
            }
        }
        CHECK(hangar.center().x() == Approx(53.0).margin(0.01));
        CHECK(hangar.center().y() == Approx(-88.4).margin(0.01));
        const auto at = place_in_picture(pose, pixel_rays(pose), hangar.center());
        REQUIRE(at);
        CHECK(at->x() == Approx(32.0).margin(1e-6));
        CHECK(at->y() == Approx(24.0).margin(1e-6));
    }
}

TEST_CASE("a log of latitudes and attitudes is flown as it says", "[scenes][trajectory]") {
    const Prepared scene = prepared(R"(
[[trajectory]]
name = "log"
file = "way.csv"
heights = "ellipsoid"
[[observer]]
name = "drone"
trajectory = "log"
mount_deg = [10.0, -90.0, 0.0]
frames = ["2026-07-15T10:00:01-04:00", "2026-07-15T10:00:02-04:00"]
)" + camera,
                                    "time,latitude_deg,longitude_deg,height_m,heading_deg\n"
                                    "2026-07-15T14:00:00Z,36.315,-84.21,800,350\n"
                                    "2026-07-15T14:00:02Z,36.317,-84.20,820,10\n");
    const Sequence& drone = scene.sequences.at(0);
    const Geodetic end = to_geodetic(scene.world.site, drone.at(1).position);
    CHECK(end.latitude_deg == Approx(36.317).margin(1e-9));
    CHECK(end.longitude_deg == Approx(-84.20).margin(1e-9));
    CHECK(end.height == Approx(820.0).margin(1e-6));
    // Straight down; the upper edge looks 10 degrees to the right of the heading, 0 and 10 degrees.
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(drone.at(i).elevation_deg == Approx(-90.0));
        CHECK(drone.at(i).azimuth_deg == Approx(10.0 + 10.0 * double(i)));
    }
}

TEST_CASE("a camera with an exposure time blurs by its motion and its turn",
          "[scenes][trajectory]") {
    // Level with the ground at 100 m/s over it, always turned to a place 1000 m beside the way's
    // middle: there it turns by v / r, to the left, as the place falls back on its left.
    const Prepared scene = prepared(R"(
[[trajectory]]
name = "past"
waypoints_m = [[-1000.0, 1000.0, 1500.0], [1000.0, 1000.0, 1500.0]]
speed_m_s = 100.0
heights = "sea"
[[observer]]
name = "side"
trajectory = "past"
look_at_m = [0.0, 2000.0]
exposure_s = 0.01
frames = ["2026-07-15T00:00:10-04:00"]
)" + camera);
    const Observer& side = scene.sequences.at(0).at(0);
    CHECK(side.velocity.x() == Approx(100.0).epsilon(1e-6));
    CHECK(std::abs(side.velocity.y()) < 1e-6);
    // The rate of the azimuth is v over the distance in plan; the axis stands upright, less what
    // the way's bend to the earth adds.
    CHECK(side.turning.z() == Approx(0.1).epsilon(1e-3));
    CHECK(std::remainder(side.azimuth_deg, 360.0) == Approx(0.0).margin(0.02));
}

TEST_CASE("a frame alone has the bytes it has in its sequence", "[scenes][trajectory]") {
    const ScratchFolder folder("trajectory_frames");
    write_text(folder.path / "all.toml",
               scene_with(approach + "look_at_m = [0.0, 0.0]\n" + camera));
    write_text(folder.path / "one.toml",
               scene_with(with(approach, "frame_every_s = 10.0",
                               "frames = [\"2026-07-15T12:05:20-04:00\"]") +
                          "look_at_m = [0.0, 0.0]\n" + camera));
    for (const char* name : {"all", "one"}) {
        run_job(read_scene(folder.path / (std::string(name) + ".toml")),
                {.out = folder.path / name, .settings = {}, .progress = ProgressStyle::silent});
    }
    const std::string frame = "frames/nose_8-12_20260715T160520Z.exr";
    const std::string alone = bytes_of(folder.path / "one" / frame);
    REQUIRE(alone.size() > 1000);
    CHECK(alone == bytes_of(folder.path / "all" / frame));
    // What it reports of its camera: half of the way, 2828 m long in plan.
    const Frame read = read_exr(folder.path / "one" / frame);
    const std::string place = read.attributes.at("camera.position_m");
    double east = 0.0, north = 0.0;
    REQUIRE(std::sscanf(place.c_str(), "%lf %lf", &east, &north) == 2);
    CHECK(east == Approx(-1000.0).margin(1e-3));
    CHECK(north == Approx(-1000.0).margin(1e-3));
    // The middle of the picture is as far as half of the way is from the point at its end, on the
    // ground: the eye's height over it is known from the sea's.
    const float range = read["range"].pixel[24 * 64 + 32];
    CHECK(range > 1414.0f);
    CHECK(range < 1600.0f);
    // Four instants of pictures lie between two steps of the balance.
    const TemperatureField field = load_temperature_field(folder.path / "all" / "temperatures.nc");
    for (const Instant when : field.instant) {
        CHECK(std::fmod(seconds_between(parse_instant("2026-07-15T04:00:00Z"), when), 600.0) ==
              0.0);
    }
}

TEST_CASE("what a trajectory or its observer cannot be is refused", "[scenes][trajectory][input]") {
    const auto reported = [](const std::string& text, const std::string& csv = "") {
        try {
            prepared(text, csv);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Contains;
    const std::string aimed = approach + "look_at_m = [0.0, 0.0]\n" + camera;
    CHECK(reported(aimed).empty());
    CHECK_THAT(reported(with(aimed, "[0.0, 40.0]", "[0.0, 40.0, 50.0]")),
               Contains("3 numbers for 2 waypoints"));
    CHECK_THAT(reported(with(aimed, "[0.0, 40.0]", "[0.0, 0.0]")),
               Contains("not later than time 1"));
    CHECK_THAT(reported(with(aimed, "trajectory = \"approach\"", "trajectory = \"aproach\"")),
               Contains("aproach") && Contains("approach"));
    CHECK_THAT(reported(with(aimed, "look_at_m = [0.0, 0.0]", "look_at = \"hanger\"")),
               Contains("hanger") && Contains("hangar"));
    CHECK_THAT(reported(with(aimed, "frame_every_s = 10.0", "place_m = [0.0, 0.0]")),
               Contains("place_m") && Contains("combined with a trajectory"));
    CHECK_THAT(reported(with(aimed, "frame_every_s = 10.0\n", "")),
               Contains("frame_every_s or frames"));
    CHECK_THAT(
        reported(with(aimed, "frame_every_s = 10.0", "frames = [\"2026-07-15T14:00:00-04:00\"]")),
        Contains("outside trajectory \"approach\" in the span"));
    CHECK_THAT(reported(with(aimed, "2026-07-15T12:05", "2026-08-15T12:05")),
               Contains("outside the span of [time]"));
    CHECK_THAT(reported(with(aimed, "heights = \"sea\"", "heights = \"sea\"\ncurve = \"smooth\"")),
               Contains("at least 3"));
    // Below the ground, with the instant.
    CHECK_THAT(reported(with(aimed, "[0.0, 0.0, 500.0]]", "[900.0, 900.0, 50.0]]")),
               Contains("below the terrain") && Contains("at 2026"));
    const std::string log =
        with(with(aimed, "waypoints_m = [[-2000.0, -2000.0, 900.0], [0.0, 0.0, 500.0]]\n", ""),
             "times_s = [0.0, 40.0]", "file = \"way.csv\"");
    CHECK_THAT(reported(log), Contains("no such file"));
    CHECK_THAT(reported(log, "time_s,east_m,north_m\n0,0,0\n1,0,0\n"), Contains("height_m"));
    // Columns that contradict each other, that nobody reads, or that are there twice.
    const std::string rows = "\n0,0,0,900,0\n9,0,0,900,9\n";
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m,time" + rows),
               Contains("'time' and 'time_s', expected only one"));
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m,latitude_deg" + rows),
               Contains("'east_m' and 'latitude_deg', expected only one"));
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m,headng_deg" + rows),
               Contains("unknown column 'headng_deg'") && Contains("heading_deg"));
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m,height_m" + rows),
               Contains("'height_m' twice"));
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m,pitch_deg" + rows),
               Contains("'pitch_deg' without 'heading_deg'"));
    // One mistake, one line.
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n') + 1;
    };
    const std::string resting =
        with(with(aimed, "[0.0, 0.0, 500.0]]", "[-2000.0, -2000.0, 900.0]]"),
             "times_s = [0.0, 40.0]", "speed_m_s = 50.0");
    CHECK_THAT(reported(resting), Contains("waypoints_m") && Contains("constant speed"));
    CHECK(lines(reported(resting)) == 1);
    const std::string beside =
        with(log, "file = \"way.csv\"", "file = \"way.csv\"\nspeed_m_s = 5.0");
    const std::string way = "time_s,east_m,north_m,height_m\n0,-2000,-2000,900\n40,0,0,500\n";
    CHECK_THAT(reported(beside, way), Contains("speed_m_s") && Contains("combined with file"));
    CHECK(lines(reported(beside, way)) == 1);
    CHECK_THAT(reported(log, "time_s,east_m,north_m,height_m\n0,0,0,900\n0,0,0,900\n"),
               Contains("way.csv:3:1") && Contains("not later"));
    CHECK_THAT(reported(log,
                        "time_s,east_m,north_m,height_m,qw,qx,qy,qz\n0,0,0,900,1,0,0,0\n"
                        "9,0,0,900,2,0,0,0\n"),
               Contains("way.csv:3:5") && Contains("length 2"));
    // What follows from a mistake is none: a way that is wrong, and pictures within it.
    const std::string two =
        with(aimed, "frame_every_s = 10.0", "frames = [\"2026-07-15T12:05:10-04:00\"]");
    for (const std::string& wrong :
         {with(two, "[0.0, 40.0]", "[40.0, 0.0]"), with(two, "[0.0, 40.0]", "[0.0, nan]"),
          with(two, "[0.0, 40.0]", "[0.0]"), with(two, "12:05:00-04:00", "12:05:00"),
          with(two, "frames = [\"2026-07-15T12:05:10-04:00\"]",
               "frames_at_sun = { elevation_deg = 10.0, azimuth_deg = 90.0 }")}) {
        CAPTURE(reported(wrong));
        CHECK(lines(reported(wrong)) == 1);
    }
    // A picture outside a way says whose.
    CHECK_THAT(reported(with(two, "12:05:10", "13:05:10")),
               Contains("outside trajectory \"approach\"") && Contains("12:05:40"));
    // Where the mistake stands.
    const std::string still =
        "[[observer]]\nname = \"still\"\nplace_m = [0.0, 0.0]\n"
        "height_above_ground_m = 40.0\n" +
        camera;
    CHECK_THAT(reported(still + "look_at_m = [0.0, 9e5]\n"),
               Contains("observer.look_at_m: ") && Contains("is outside"));
    CHECK_THAT(reported(with(still, "[0.0, 0.0]", "[0.0, 9e5]") + "look_at_m = [0.0, 0.0]\n"),
               Contains("observer.place_m: ") && Contains("is outside"));
    CHECK_THAT(
        reported(still + "azimuth_deg = 0.0\nelevation_deg = 0.0\nvelocity_m_s = [0, 0, 0]\n"),
        Contains("velocity_m_s: is zero"));
    CHECK_THAT(reported(still + "azimuth_deg = 0.0\nelevation_deg = 0.0\nlook_at = \"hangar\"\n"),
               Contains("several line-of-sight keys"));
    CHECK(lines(reported(still +
                         "azimuth_deg = 0.0\nelevation_deg = 0.0\nlook_at = \"hangar\"\n")) == 1);
}
