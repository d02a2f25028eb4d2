#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/hourly_sun.hpp"
#include "tests/support/small_scene.hpp"

/// A folder with a whole small scene in it, and what may be done to it: level ground of 300 m, a
/// yard, a hall, a box of 2 m, a camera, three days of July measured by the hour.
namespace diurna::testing {

/// One change of the folder.
using Edit = std::function<void(const std::filesystem::path& folder)>;

inline std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    REQUIRE(in);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A file of this text, in the place of one of its name.
inline Edit holds(std::string file, std::string text) {
    return [=](const std::filesystem::path& folder) {
        std::ofstream(folder / file, std::ios::binary) << text;
    };
}
inline Edit without(std::string file) {
    return [=](const std::filesystem::path& folder) { std::filesystem::remove(folder / file); };
}
/// The first `from` of a file as `to`.
inline Edit swap(std::string file, std::string from, std::string to) {
    return [=](const std::filesystem::path& folder) {
        std::string text = text_of(folder / file);
        const std::size_t at = text.find(from);
        INFO("to be changed in " << file << ": " << from);
        REQUIRE(at != std::string::npos);
        holds(file, text.replace(at, from.size(), to))(folder);
    };
}
/// Every one.
inline Edit swap_all(std::string file, std::string from, std::string to) {
    return [=](const std::filesystem::path& folder) {
        std::string text = text_of(folder / file), out;
        std::size_t at = 0, next = 0;
        for (; (next = text.find(from, at)) != std::string::npos; at = next + from.size()) {
            out += text.substr(at, next - at) + to;
        }
        holds(file, out + text.substr(at))(folder);
    };
}
inline Edit in_scene(std::string from, std::string to) {
    return swap("scene.toml", std::move(from), std::move(to));
}
/// More at a file's end.
inline Edit adds(std::string file, std::string text) {
    return [=](const std::filesystem::path& folder) {
        holds(file, text_of(folder / file) + text)(folder);
    };
}
inline Edit scene_adds(std::string text) { return adds("scene.toml", "\n" + text + "\n"); }

/// Every number of a column of july.csv by a law.
inline Edit column(std::size_t place, std::function<double(double)> law) {
    return [=](const std::filesystem::path& folder) {
        std::string out;
        const std::string text = text_of(folder / "july.csv");
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = text.find('\n', begin);
            std::string line = text.substr(begin, end - begin);
            std::size_t from = 0;
            for (std::size_t c = 0; c < place; ++c) from = line.find(',', from) + 1;
            const std::size_t to = std::min(line.find(',', from), line.size());
            if (begin > 0) {
                const double value = law(std::stod(line.substr(from, to - from)));
                line.replace(from, to - from, fmt::format("{:.2f}", value));
            }
            out += line + "\n";
            begin = end + 1;
        }
        holds("july.csv", out)(folder);
    };
}

/// Three days about 15 July at 36.32 N 84.2 W, each instant with its offset: air as a cosine about
/// 25 degC, sun by hourly_sun.hpp's formula, which is none of the program's.
inline std::string july() {
    const Minutes day = clear_day(36.32, "2026-07-15T00:00:00Z");
    std::string text =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,pressure_Pa,shortwave_down_W_m2\n";
    for (int hour = -24; hour <= 48; ++hour) {
        const int clock = (hour + 24) % 24;
        // 84.2 W at an offset of -4 h: the sun is 1 h 37 min behind the clock.
        const int minute = (clock * 60 - 97 + 1440) % 1440;
        text += fmt::format("2026-07-{:02}T{:02}:00:00-04:00,{:.2f},{:.2f},{:.1f},{},{:.1f}\n",
                            15 + (hour + 24) / 24 - 1, clock,
                            298.15 - 7.0 * std::cos((clock - 4) * 0.2618), 0.6, 2.0, 97800,
                            day.global[std::size_t(minute)]);
    }
    return text;
}

/// A closed box that stands on the ground, twice `half` in size.
inline std::string box(double half) {
    std::string text;
    for (const double up : {0.0, 2.0 * half}) {
        for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
            text += fmt::format("v {} {} {}\n", half * x, up, half * z);
        }
    }
    return text + "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
}

inline const std::vector<std::pair<std::string, std::string>>& whole_folder() {
    static const std::vector<std::pair<std::string, std::string>> files{
        {"scene.toml", R"([scene]
name = "field"
sky_rays = 16
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = "dem.asc"
radius_m = 300.0
material = "grass"
[[ground]]
name = "yard"
material = "asphalt"
ring_m = [[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]]
[[building]]
name = "hall"
place_m = [100.0, 0.0]
width_m = 20.0
depth_m = 12.0
height_m = 8.0
wall = "concrete_wall"
[[object]]
name = "box"
mesh = "box.obj"
material = "painted_sheet"
place_m = [0.0, 5.0]
[weather]
file = "july.csv"
interval = "instant"
[time]
start = 2026-07-15T00:00:00-04:00
duration_h = 24.0
frame_every_s = 21600.0
[[observer]]
name = "east"
place_m = [200.0, -60.0]
height_above_ground_m = 30.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 15.0
width = 64
height = 48
bands = ["3-5", "8-12"]
)"},
        {"july.csv", july()},
        {"box.obj", box(1.0)},
        {"dem.asc",
         "ncols 5\nnrows 5\nxllcorner -84.215833\nyllcorner 36.3075\ncellsize 0.005\n"
         "NODATA_value -9999\n300 300 300 300 300\n300 300 300 300 300\n300 300 300 300 300\n"
         "300 300 300 300 300\n300 300 300 300 300\n"},
        {"dem.prj", R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],)"
                    R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]])"},
        {"column.toml", R"([site]
latitude_deg = 36.32
longitude_deg = -84.203333
elevation_m = 300.0
[material]
name = "asphalt"
[weather]
file = "july.csv"
interval = "instant"
[time]
start = 2026-07-15T00:00:00-04:00
end = 2026-07-16T00:00:00-04:00
step_s = 3600.0
)"},
    };
    return files;
}

/// One mistake that a person makes, and what the program owes for an answer.
struct NaturalMistake {
    const char* what;
    std::vector<Edit> edits;
    const char* where;               // stands in the one line
    std::vector<std::string> mends;  // so do these
    int code = 2;                    // 0: a warning; or, without `where`, nothing at all
    const char* command = "check scene.toml";
};

}  // namespace diurna::testing
