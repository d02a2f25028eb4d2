#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/scratch_folder.hpp"

inline void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

/// `text` with the first `from` put as `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// A few square kilometres of the default scene on a coarse mesh, four frames of 64 x 48: a whole
/// job in a second or two.
inline std::string small_scene() {
    const std::string folder = DIURNA_SOURCE_DIR "/scenes/jacksboro/";
    return R"([scene]
name = "small"
sky_rays = 32
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = ")" +
           folder + R"(elevation.tif"
radius_m = 4000.0
tolerance_m = 10.0
material = "grass"
[[terrain.rule]]
material = "forest"
slope_deg = [7.0, 90.0]
[[ground]]
name = "runway"
material = "asphalt"
rectangle_m = [0.0, 0.0, 1500.0, 45.0, 45.0]
largest_edge_m = 60.0
[[building]]
name = "hangar"
place_m = [53.0, -88.4]
width_m = 60.0
depth_m = 40.0
height_m = 12.0
heading_deg = 45.0
wall = "concrete_wall"
front = "glass"
roof = "painted_steel"
[weather]
file = ")" +
           folder + R"(weather.csv"
interval = "instant"
[time]
start = 2026-07-15T00:00:00-04:00
step_s = 1200.0
frame_every_s = 21600.0
[[observer]]
name = "east"
place_m = [2000.0, 1100.0]
height_above_ground_m = 450.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 24.0
width = 64
height = 48
samples = 16
bands = ["3-5", "8-12"]
)";
}
