#pragma once

#include <fmt/format.h>

#include <map>
#include <string>

/// A scene of 40 x 40 posts with one of nearly everything, checked in a tenth of a second: what the
/// corpus changes a little, so that nothing but the change can be wrong.
namespace yard {

inline std::string posts(const std::string& head, int count, const std::string& height = "100") {
    std::string text = head;
    for (int i = 0; i < count; ++i) text += height + (i % 40 == 39 ? "\n" : " ");
    return text;
}

inline const std::string raster_head =
    "ncols 40\nnrows 40\nxllcorner 500000\nyllcorner 5205000\ncellsize 10\nNODATA_value -9999\n";

inline const std::string projection =
    "PROJCS[\"UTM 32\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
    "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION["
    "\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\","
    "9],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],PARAMETER["
    "\"false_northing\",0],UNIT[\"metre\",1]]";

inline const std::string weather_head =
    "time,air_temperature_K,relative_humidity,pressure_Pa,wind_speed_m_s,direct_normal_W_m2,"
    "diffuse_W_m2,longwave_down_W_m2\n";

/// The row of an hour, with `cell` in its `column`-th.
inline std::string weather_row(int hour, int column = -1, const std::string& cell = "") {
    const std::string cells[] = {
        fmt::format("2026-06-{:02}T{:02}:00:00Z", 20 + hour / 24, hour % 24),
        fmt::format("{}", 285 + (hour % 24) / 2),
        "0.5",
        "100000",
        "3",
        hour % 24 > 6 && hour % 24 < 18 ? "600" : "0",
        hour % 24 > 6 && hour % 24 < 18 ? "80" : "0",
        "320"};
    std::string row;
    for (int c = 0; c < 8; ++c) row += (c ? "," : "") + (c == column ? cell : cells[c]);
    return row + "\n";
}

inline std::string weather(int at_hour = -1, int column = -1, const std::string& cell = "") {
    std::string text = weather_head;
    for (int h = 0; h <= 24; ++h) text += weather_row(h, h == at_hour ? column : -1, cell);
    return text;
}

inline const std::string crate =
    "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv -2 -2 2\nv 2 -2 2\nv 2 2 2\nv -2 2 2\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

inline const std::string spectrum =
    "wavelength_um,reflectance\n0.3,0.2\n1.0,0.4\n3.0,0.1\n20,0.05\n";
inline const std::string response = "wavelength_um,response\n8,0\n9,1\n11,1\n12,0\n";
inline const std::string way =
    "time_s,east_m,north_m,height_m\n0,-100,0,50\n60,0,20,50\n120,100,0,50\n";

inline const std::string scene = R"([scene]
name = "yard"
seed = 1
sky_rays = 32
object_sky_rays = 32
sun_samples = 4
[terrain]
elevation = "plain.asc"
material = "grass"
tolerance_m = 1.0
refraction = 0.1
[[terrain.rule]]
material = "rock"
slope_deg = [33.0, 90.0]
height_m = [50.0, 2000.0]
[material.own]
reflectance = "own.csv"
roughness_length_m = 0.01
layers = [{ thickness_m = 0.3, conductivity_W_mK = 1.0, density_kg_m3 = 2000.0, heat_capacity_J_kgK = 800.0 }]
bottom = { kind = "temperature", value_K = 288.0 }
[[ground]]
name = "pad"
material = "own"
texture = "spots"
rectangle_m = [0.0, 0.0, 40.0, 30.0, 10.0]
largest_edge_m = 10.0
[[ground]]
name = "strip"
material = "asphalt"
ring_m = [[-80.0, -80.0], [-40.0, -80.0], [-40.0, -40.0], [-80.0, -40.0]]
largest_edge_m = 10.0
[[texture]]
name = "spots"
kind = "clutter"
std = 0.05
correlation_length_m = 5.0
seed = 2
[[building]]
name = "hut"
place_m = [60.0, 60.0]
width_m = 8.0
depth_m = 6.0
height_m = 4.0
heading_deg = 20.0
wall = "concrete_wall"
[[object]]
name = "crate"
mesh = "crate.obj"
up = "z"
material = "painted_steel"
place_m = [10.0, 5.0]
heading_deg = 30.0
largest_edge_m = 2.0
[[plume]]
name = "smoke"
place_m = [-20.0, 30.0]
radius_m = 3.0
height_above_ground_m = 5.0
height_m = 8.0
temperature_K = 300.0
absorption_per_m = 0.1
[[trajectory]]
name = "way"
file = "way.csv"
[weather]
file = "weather.csv"
[time]
start = 2026-06-20T00:00:00Z
duration_h = 24.0
step_s = 1200.0
frame_every_s = 43200.0
spin_up = "periodic"
[atmosphere]
profile = "MLS"
aerosol = "rural"
visibility_km = 23.0
[[bands]]
name = "long"
response = "long.csv"
[[cubes]]
name = "fine"
range_um = [8.0, 12.0]
channels = 8
[[observer]]
name = "east"
place_m = [150.0, 50.0]
height_above_ground_m = 40.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 24.0
width = 32
height = 24
samples = 4
bands = ["8-12", "long"]
cubes = ["fine"]
[[observer]]
name = "flyer"
trajectory = "way"
mount_deg = [0.0, -90.0, 0.0]
width = 32
height = 24
exposure_s = 0.001
bands = ["3-5"]
frames = ["2026-06-20T00:01:00Z"]
)";

inline const std::string column = R"([site]
latitude_deg = 47.0
longitude_deg = 9.0
elevation_m = 100.0
[facet]
slope_deg = 0.0
aspect_deg = 180.0
[material]
albedo = 0.3
emissivity = 0.95
roughness_length_m = 0.01
layers = [{ thickness_m = 0.3, conductivity_W_mK = 1.0, density_kg_m3 = 2000.0, heat_capacity_J_kgK = 800.0 }]
bottom = { kind = "temperature", value_K = 288.0 }
[weather]
file = "weather.csv"
[time]
start = 2026-06-20T00:00:00Z
end = 2026-06-20T06:00:00Z
step_s = 1800.0
)";

inline std::map<std::string, std::string> files() {
    return {{"scene.toml", scene},
            {"column.toml", column},
            {"plain.asc", posts(raster_head, 1600)},
            {"plain.prj", projection},
            {"weather.csv", weather()},
            {"crate.obj", crate},
            {"own.csv", spectrum},
            {"long.csv", response},
            {"way.csv", way}};
}

}  // namespace yard
