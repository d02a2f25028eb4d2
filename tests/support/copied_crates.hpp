#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/small_scene.hpp"

/// Crates on a level lot, as copies of one or built out one by one.
namespace copied_crates {

inline constexpr double alike_within = 1.0;  // [K]

struct Stand {
    double east, north, heading_deg;
};

/// Two rows of five, one of them a little round, and one by itself that heads another way.
inline const std::vector<Stand> stands = [] {
    std::vector<Stand> all;
    for (const double north : {-6.0, 6.0}) {
        for (int i = 0; i < 5; ++i) {
            all.push_back({9.0 * i - 18.0, north, i == 3 && north > 0.0 ? 20.8 : 20.0});
        }
    }
    all.push_back({0.0, 40.0, 75.0});
    return all;
}();

inline const std::string crate = R"(v -1.2 -2 0
v 1.2 -2 0
v 1.2 2 0
v -1.2 2 0
v -1.2 -2 2
v 1.2 -2 2
v 1.2 2 1.4
v -1.2 2 1.4
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

inline const std::string about_crate = R"(mesh = "crate.obj"
up = "z"
class = "crate"
material = "painted_sheet"
largest_edge_m = 0.7
height_above_ground_m = 0.3
)";

inline std::string scene_text(const std::string& objects) {
    return R"([scene]
name = "yard"
sky_rays = 64
object_sky_rays = 256
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = "level.asc"
radius_m = 400.0
material = "grass"
[[ground]]
name = "lot"
material = "concrete"
rectangle_m = [0.0, 0.0, 160.0, 160.0, 0.0]
[weather]
file = ")" DIURNA_SOURCE_DIR R"(/scenes/jacksboro/weather.csv"
interval = "instant"
[time]
start = 2026-07-15T00:00:00-04:00
step_s = 1200.0
frames = ["2026-07-15T09:00:00-04:00", "2026-07-15T14:00:00-04:00"]
[[observer]]
name = "mast"
place_m = [-25.0, -60.0]
height_above_ground_m = 30.0
look_at_m = [2.0, 2.0]
horizontal_fov_deg = 34.0
width = 240
height = 160
samples = 16
bands = ["3-5", "8-12"]
)" + objects;
}

inline std::string copies(double within, const std::vector<Stand>& places = stands) {
    std::string rows;
    for (const Stand& s : places) {
        rows += fmt::format("[{}, {}, {}], ", s.east, s.north, s.heading_deg);
    }
    return fmt::format(
               "[[object]]\nname = \"crate\"\ncopies = [{}]\ncopies_alike_K = {}\nstands = "
               "\"upright\"\n",
               rows, within) +
           about_crate;
}

inline std::string apart(const std::vector<Stand>& places) {
    std::string all;
    for (std::size_t i = 0; i < places.size(); ++i) {
        all += fmt::format(
                   "[[object]]\nname = \"crate_{:04}\"\nplace_m = [{}, {}]\nheading_deg = "
                   "{}\nstands = \"upright\"\n",
                   i + 1, places[i].east, places[i].north, places[i].heading_deg) +
               about_crate;
    }
    return all;
}

inline std::filesystem::path written(const std::filesystem::path& folder,
                                     const std::string& objects) {
    std::filesystem::create_directories(folder);
    write_text(folder / "crate.obj", crate);
    for (const char* file : {"level.asc", "level.prj"}) {
        std::filesystem::copy_file(
            std::filesystem::path(DIURNA_SOURCE_DIR "/scenes/crossover") / file, folder / file,
            std::filesystem::copy_options::overwrite_existing);
    }
    write_text(folder / "scene.toml", scene_text(objects));
    return folder / "scene.toml";
}

}  // namespace copied_crates
