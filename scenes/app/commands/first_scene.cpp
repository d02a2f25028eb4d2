#include "scenes/app/commands/first_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// As a text between quotes in TOML.
std::string in_quotes(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string ground_text(const FirstScene& scene) {
    std::string text =
        fmt::format(R"(# A first scene, written by diurna new. Next:
#
#   diurna check scene.toml     report errors and warnings
#   diurna plan scene.toml      list the computations, with time and memory
#   diurna run scene.toml       pictures, temperatures and report.html into the folder out
#
# All keys with units and ranges: diurna keys. Lengths in metres; places are [east, north] from the site.

[scene]
name = "{}"

[site]  # centre of the scene, at the height of the ground
latitude_deg = {:.6f}
longitude_deg = {:.6f}

[terrain]
elevation = "{}"
radius_m = {:.0f}      # half the side of the square of ground around the site that is used
tolerance_m = 1.0    # largest vertical distance between mesh and elevation posts
material = "grass"   # default material of the ground; list of materials: diurna materials
)",
                    in_quotes(scene.name), scene.place.latitude_deg, scene.place.longitude_deg,
                    in_quotes(scene.elevation), scene.radius);
    if (scene.fills_voids) text += "voids = \"fill\"      # interpolates posts without elevation\n";
    return text;
}

constexpr const char* things = R"(
[[ground]]             # later polygons cover earlier ones; ring_m = [[east, north], ...] for other shapes
name = "yard"
material = "asphalt"
rectangle_m = [0.0, 0.0, 40.0, 30.0, 0.0]  # east, north, length, width, heading of the length
largest_edge_m = 4.0   # of the polygon's triangles

[[object]]             # or mesh = "FILE.obj"; list of built-in models: diurna model
name = "truck"
model = "truck"
place_m = [-8.0, 0.0]
heading_deg = 30.0

[[object]]
name = "generator"
model = "generator"
place_m = [8.0, 2.0]
heading_deg = 120.0
# running = ["06:00-18:00"]
)";

std::string weather_text(const FirstScene& scene) {
    std::string text =
        fmt::format(R"(
[weather]
file = "{}"{}
)",
                    in_quotes(scene.weather),
                    scene.weather_made_up
                        ? "  # generated, not measured: replace it by a measured file. A clear "
                          "day: air temperature linear between\n# 15 degC at 5 h and 29 degC at 15 "
                          "h, relative humidity 50 % at 15 h, wind 2 m/s; sun and sky are modelled"
                        : "  # quantities that the file lacks are modelled and reported");
    if (scene.weather_made_up) text += "interval = \"instant\"\n";
    if (!scene.columns.empty()) {
        text +=
            "\n[weather.columns]  # by their names in the header: compare with the file's page\n";
    }
    for (const std::string& line : scene.columns) text += line + "\n";
    return text;
}

std::string pictures_text(const FirstScene& scene) {
    const double eye = std::min(120.0, 0.4 * scene.radius);  // [m] south of the middle
    return fmt::format(R"(
[atmosphere]           # between surface and camera
visibility_km = 23.0   # the air above follows the weather's mean temperature; profile = "MLW"
                       # names an AFGL profile, sounding = "FILE" a measured one

[time]
start = {}
duration_h = {:g}
frame_every_s = 3600.0 # one picture per hour

[[observer]]
name = "south"
place_m = [0.0, -{:.0f}.0]
height_above_ground_m = 25.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 30.0
width = 320
height = 256
bands = ["3-5", "8-12"]  # um; "0.4-0.7" is visible light

# When truck and yard have the same apparent temperature: diurna crossover scene.toml
[[crossover]]
first = "truck"
second = "yard"

# Contrast of the targets with their background: diurna contrast scene.toml
[[contrast]]
targets = ["truck", "generator"]
)",
                       format_local(scene.start, scene.utc_offset), scene.duration_h, eye);
}

}  // namespace

std::string first_scene_text(const FirstScene& scene) {
    return ground_text(scene) + things + weather_text(scene) + pictures_text(scene);
}

std::string clear_day(Instant day, double utc_offset) {
    constexpr double coldest = 288.15, warmest = 302.15, cold_hour = 5.0, warm_hour = 15.0;
    const double vapour = 0.5 * saturation_vapour_pressure(warmest);
    std::string text = "time,air_temperature_K,relative_humidity,wind_speed_m_s\n";
    for (int hour = -24; hour <= 48; ++hour) {
        const double clock = (hour + 24) % 24;
        const double up = (clock - cold_hour) / (warm_hour - cold_hour);
        const double after =
            std::fmod(clock - warm_hour + 24.0, 24.0) / (24.0 - (warm_hour - cold_hour));
        const double share = up >= 0.0 && up <= 1.0 ? up : 1.0 - after;
        const double air = coldest + (warmest - coldest) * share;
        text += fmt::format("{},{:.2f},{:.3f},2.0\n",
                            format_local(later(day, 3600.0 * hour), utc_offset), air,
                            std::min(1.0, vapour / saturation_vapour_pressure(air)));
    }
    return text;
}

}  // namespace diurna
