#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;
namespace fs = std::filesystem;

// A crate that goes east at 5 m/s before a camera 60 m south of its way, whose rows are read 20 ms
// apart: each row finds it 0.1 m further. By hand: a place at x, seen at a row r from the top, is
// at column c + f (x + v r dt) / y.
TEST_CASE("labels of moving objects are where the rows show them", "[scenes][labels][rows]") {
    const ScratchFolder folder("row_labels");
    for (const char* file : {"level.asc", "level.prj"}) {
        fs::copy_file(fs::path(DIURNA_SOURCE_DIR "/scenes/crossover") / file, folder.path / file);
    }
    write_text(folder.path / "crate.obj", crate_mesh);
    write_text(folder.path / "scene.toml", R"([scene]
name = "rows"
sky_rays = 16
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = "level.asc"
radius_m = 400.0
material = "dry_grass"
[[trajectory]]
name = "east"
start = 2026-07-15T12:00:00-04:00
waypoints_m = [[-30.0, 0.0, 0.0], [170.0, 0.0, 0.0]]
speed_m_s = 5.0
heights = "ground"
[[object]]
name = "crate"
mesh = "crate.obj"
up = "z"
class = "crate"
material = "painted_sheet"
trajectory = "east"
[weather]
file = ")" DIURNA_SOURCE_DIR R"(/scenes/jacksboro/weather.csv"
interval = "instant"
[time]
start = 2026-07-15T10:00:00-04:00
duration_h = 4.0
step_s = 1200.0
[[observer]]
name = "south"
place_m = [0.0, -60.0]
height_above_ground_m = 1.0
azimuth_deg = 0.0
elevation_deg = 0.0
horizontal_fov_deg = 60.0
width = 320
height = 96
samples = 16
row_time_s = 0.02
bands = ["8-12"]
frames = ["2026-07-15T12:00:04-04:00"]
)");
    run_job(read_scene(folder.path / "scene.toml"), {.out = folder.path / "out", .settings = {}});
    const nlohmann::json book =
        nlohmann::json::parse(std::ifstream(folder.path / "out" / "annotations.json"));
    REQUIRE(book["annotations"].size() == 1);
    const nlohmann::json& label = book["annotations"][0];
    const auto box = [&](const char* name) {
        const std::vector<double> of = label[name].get<std::vector<double>>();
        return std::array<double, 4>{of[0], of[1], of[0] + of[2], of[1] + of[3]};
    };
    const std::array<double, 4> seen = box("bbox"), whole = box("amodal_bbox");
    const double focal = 160.0 / std::tan(30.0 * std::acos(-1.0) / 180.0);
    // It is at -10 m when the picture begins; its near side is 58 m away, its top 1 m above the
    // eye, its foot 1 m below: from row 48 - f / 58 on, to 48 + f / 58.
    // Left of the axis, its right edge is the far side's, 62 m away.
    const auto column = [&](double x, double row, double away) {
        return 160.0 + focal * (-10.0 + x + 5.0 * 0.02 * std::floor(row)) / away;
    };
    const double top = 48.0 - focal / 58.0, foot = 48.0 + focal / 58.0;
    CHECK(whole[1] == Approx(top).margin(0.3));
    CHECK(whole[3] == Approx(foot).margin(0.3));
    CHECK(whole[0] == Approx(column(-2.0, top, 58.0)).margin(0.6));
    CHECK(whole[2] == Approx(column(2.0, 48.0 + focal / 62.0, 62.0)).margin(0.6));
    for (int k = 0; k < 4; ++k) CHECK(seen[k] == Approx(whole[k]).margin(1.5));
    CHECK(label["occlusion"].get<double>() < 0.05);
    CHECK(label["truncation"].get<double>() == 0.0);
    // Its middle when row 48 is read.
    CHECK(label["range_m"].get<double>() ==
          Approx(std::hypot(-10.0 + 5.0 * 0.02 * 48.0, 60.0)).margin(0.15));
}
