#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/small_scene.hpp"

/// A hall in the sun on a plain, where nothing emits or reflects.
namespace diurna::testing::sunlit_hall {

inline constexpr double air = 285.0, film = 8.0, beam = 800.0;
inline constexpr double through_wall = 1.0 / (0.002 / 1.0 + 1.0 / 10.0);  // [W m⁻² K⁻¹]
inline constexpr double size = 12.0, height = 5.0;                        // of the hall [m]

/// A plain that rises to the east.
inline std::string plain(double slope) {
    std::string text =
        "ncols 60\nnrows 60\nxllcorner 577900\nyllcorner 4983000\ncellsize 5\nNODATA_value -9999\n";
    for (int row = 0; row < 60; ++row) {
        for (int column = 0; column < 60; ++column) {
            text += fmt::format("{:.4f} ", 200.0 + slope * 5.0 * (column - 29.5));
        }
        text += "\n";
    }
    return text;
}

inline std::string thin(const char* name) {
    return fmt::format(R"([material.{}]
albedo = 0.0
emissivity = 0.0
roughness_length_m = 0.01
layers = [{{ thickness_m = 0.002, conductivity_W_mK = 1.0, density_kg_m3 = 1000.0, heat_capacity_J_kgK = 500.0 }}]
bottom = {{ kind = "interior", air_temperature_K = {}, film_W_m2K = 10.0 }}
convection = {{ kind = "constant", value_W_m2K = {} }}
)",
                       name, air, film);
}

struct Hall {
    Prepared prepared;
    TemperatureField temperature;
};

inline Hall hall(double slope) {
    const ScratchFolder folder("wall-foot");
    write_text(folder.path / "plain.asc", plain(slope));
    write_text(
        folder.path / "plain.prj",
        "PROJCS[\"WGS 84 / UTM zone 32N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
        "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
        "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_"
        "origin\",0],PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
        "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\","
        "1]]");
    std::string weather =
        "time,air_temperature_K,wind_speed_m_s,direct_normal_W_m2,diffuse_W_m2,longwave_down_W_"
        "m2\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format("2026-03-{:02}T{:02}:00:00Z,{},3,{},0,300\n", 21 + h / 24, h % 24,
                               air, h > 6 && h < 18 ? beam : 0.0);
    }
    write_text(folder.path / "weather.csv", weather);
    write_text(folder.path / "scene.toml", fmt::format(R"([scene]
name = "foot"
sky_rays = 32
[terrain]
elevation = "plain.asc"
material = "ground"
tolerance_m = 1.0
[[building]]
name = "house"
place_m = [0.0, 0.0]
width_m = {0}
depth_m = {0}
height_m = {1}
heading_deg = 180.0
wall = "wall"
{2}{3}[weather]
file = "weather.csv"
interval = "instant"
[time]
start = 2026-03-21T00:00:00Z
frame_every_s = 3600.0
[[observer]]
name = "o"
place_m = [0.0, -60.0]
height_above_ground_m = 20.0
look_at_m = [0.0, 0.0]
bands = ["8-12"]
)",
                                                       size, height, thin("ground"), thin("wall")));
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(result.temperature)};
}

}  // namespace diurna::testing::sunlit_hall
