#pragma once

#include <filesystem>
#include <string>

#include "tests/support/small_scene.hpp"

/// A level black plain in a vacuum, where pictures show what temperatures are: without an observer
/// and what lies on it, which `more` has.
inline std::string black_plain(const std::string& more) {
    return std::string(R"([scene]
name = "plain"
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = "level.asc"
radius_m = 300.0
material = "black"
[material.black]
like = "asphalt"
emissivity = 1.0
albedo = 0.0
[weather]
file = ")" DIURNA_SOURCE_DIR R"(/scenes/jacksboro/weather.csv"
interval = "instant"
[atmosphere]
profile = "vacuum"
[time]
start = 2026-07-15T00:00:00-04:00
frame_every_s = 21600.0
)") + more;
}

/// A plate of 30 m in the middle of it, and a drone 60 m above.
inline std::string plate_below_drone(const std::string& material, const std::string& bands) {
    return "[[ground]]\nname = \"plate\"\nmaterial = \"" + material + R"("
rectangle_m = [0.0, 0.0, 30.0, 30.0, 0.0]
largest_edge_m = 10.0
[[observer]]
name = "drone"
place_m = [0.0, 0.0]
height_above_ground_m = 60.0
azimuth_deg = 0.0
elevation_deg = -90.0
horizontal_fov_deg = 60.0
width = 48
height = 32
samples = 4
bands = )" +
           bands + "\n";
}

/// Such a scene in a folder of its own, with the level ground that it names.
inline void lay(const ScratchFolder& folder, const std::string& text) {
    for (const char* name : {"level.asc", "level.prj"}) {
        std::filesystem::copy_file(
            std::filesystem::path(DIURNA_SOURCE_DIR "/scenes/crossover") / name, folder.path / name,
            std::filesystem::copy_options::overwrite_existing);
    }
    write_text(folder.path / "scene.toml", text);
}
