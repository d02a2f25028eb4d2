#include "scenes/commands/first_scene.hpp"

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

}  // namespace

std::string first_scene_text(const FirstScene& scene) {
    const double eye = std::min(120.0, 0.4 * scene.radius);  // [m] south of the middle
    std::string text =
        fmt::format(R"(# A first scene, written by diurna new. Next:
#
#   diurna check scene.toml     every mistake at once
#   diurna plan scene.toml      what would be computed, and how long it takes
#   diurna run scene.toml       pictures, temperatures and report.html into the folder out
#
# All keys with units and ranges: diurna keys. Lengths in metres; places are [east, north] of the site.

[scene]
name = "{}"

[site]  # the middle; its height is that of the ground
latitude_deg = {:.6f}
longitude_deg = {:.6f}

[terrain]
elevation = "{}"
radius_m = {:.0f}      # of the ground that is read around the site
tolerance_m = 1.0    # no post lies farther from the mesh than this, vertically
material = "grass"   # of all ground that nothing below covers: diurna materials lists what there is
)",
                    in_quotes(scene.name), scene.place.latitude_deg, scene.place.longitude_deg,
                    in_quotes(scene.elevation), scene.radius);
    if (scene.fills_voids) text += "voids = \"fill\"      # posts without elevation in the file\n";
    text += fmt::format(R"(
[[ground]]             # later polygons lie on top; ring_m = [[east, north], ...] for other shapes
name = "yard"
material = "asphalt"
rectangle_m = [0.0, 0.0, 40.0, 30.0, 0.0]  # east, north, length, width, heading of the length
largest_edge_m = 4.0   # of its triangles

[[object]]             # mesh = "FILE.obj" for your own; diurna model lists what the program builds
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

[weather]
file = "{}"{}
)",
                        in_quotes(scene.weather),
                        scene.weather_made_up
                            ? "  # made up, no measurement: put a measured file here. A clear day, "
                              "air straight between\n# 15 degC at 5 h and 29 degC at 15 h, "
                              "vapour of half saturation at 15 h, wind of 2 m/s; sun and sky are "
                              "modelled"
                            : "  # what was not measured is modelled, and told");
    if (scene.weather_made_up) text += "interval = \"instant\"\n";
    text += fmt::format(R"(
[atmosphere]           # between surface and camera
profile = "MLS"        # mid-latitude summer; MLW, TROP, SAS, SAW, US76, or sounding = "FILE"
visibility_km = 23.0

[time]
start = {}
duration_h = {:g}
frame_every_s = 3600.0 # a picture each hour

[[observer]]
name = "south"
place_m = [0.0, -{:.0f}.0]
height_above_ground_m = 25.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 30.0
width = 320
height = 256
bands = ["3-5", "8-12"]  # um; "0.4-0.7" for what eyes see

# When the truck cannot be reported from the yard: diurna crossover scene.toml
[[crossover]]
first = "truck"
second = "yard"

# How they stand out from what is around them: diurna contrast scene.toml
[[contrast]]
targets = ["truck", "generator"]
)",
                        format_local(scene.start, scene.utc_offset), scene.duration_h, eye);
    return text;
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
