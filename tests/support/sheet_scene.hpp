#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/small_scene.hpp"

/// A mesh over a plain on the equator at equinox, under one air of 290 K.
namespace diurna::testing::over_plain {

inline constexpr double air = 290.0, film = 10.0;  // [K], [W m⁻² K⁻¹] of every face

struct Given {
    std::string mesh;                  // OBJ
    double height = 2.0;               // of its lowest point [m]
    double beam = 0.0;                 // [W m⁻²] by day
    double longwave = 0.0;             // [W m⁻²]
    double albedo = 0.0, black = 1.0;  // of all surfaces; their emissivity
    std::string sheet{};               // further keys of the mesh's material
    std::string layer = "thickness_m = 0.001, conductivity_W_mK = 50.0";
    double frame_every = 43200.0;  // [s]
    int sun_samples = 4;
    double ground_edge = 1.0;  // [m]
    std::string observer = R"(place_m = [0.0, -60.0]
height_above_ground_m = 20.0
look_at_m = [0.0, 0.0]
)";
};

/// Squares of a metre and `thickness`: one sheet that looks up, or a closed slab.
inline std::string level_square(int size, double thickness = 0.0) {
    std::string text;
    int n = 0;
    const double half = 0.5 * size;
    const auto quad = [&](std::array<Eigen::Vector3d, 4> v) {
        for (const auto& p : v) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
        text += fmt::format("f {} {} {} {}\n", n + 1, n + 2, n + 3, n + 4);
        n += 4;
    };
    for (double a = -half; a < half; a += 1.0) {
        const double b = a + 1.0;
        for (double c = -half; c < half; c += 1.0) {
            const double d = c + 1.0, z = thickness;
            quad({{{a, c, z}, {b, c, z}, {b, d, z}, {a, d, z}}});
            if (z > 0.0) quad({{{a, d, 0}, {b, d, 0}, {b, c, 0}, {a, c, 0}}});
        }
        const double h = half, z = thickness;
        if (z == 0.0) continue;
        quad({{{a, -h, 0}, {b, -h, 0}, {b, -h, z}, {a, -h, z}}});
        quad({{{b, h, 0}, {a, h, 0}, {a, h, z}, {b, h, z}}});
        quad({{{-h, b, 0}, {-h, a, 0}, {-h, a, z}, {-h, b, z}}});
        quad({{{h, a, 0}, {h, b, 0}, {h, b, z}, {h, a, z}}});
    }
    return text;
}

/// A closed block from the ground: the last eight vertices.
inline std::string block(double west, double east, double south, double north, double height) {
    std::string text;
    for (const double z : {0.0, height}) {
        for (const auto& [x, y] :
             {std::pair{west, south}, {east, south}, {east, north}, {west, north}}) {
            text += fmt::format("v {} {} {}\n", x, y, z);
        }
    }
    return text +
           "f -4 -3 -2 -1\nf -5 -6 -7 -8\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 "
           "-1\n";
}

inline void write_scene(const std::filesystem::path& folder, const Given& given) {
    std::string plain =
        "ncols 40\nnrows 40\nxllcorner -200\nyllcorner -200\ncellsize 10\nNODATA_value -9999\n";
    for (int i = 0; i < 40 * 40; ++i) plain += "100 ";
    write_text(folder / "plain.asc", plain);
    write_text(folder / "plain.prj",
               "PROJCS[\"l\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
               "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
               "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_"
               "origin\",0],PARAMETER[\"central_meridian\",0],PARAMETER[\"scale_factor\",1],"
               "PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
    std::string weather =
        "time,air_temperature_K,relative_humidity,pressure_Pa,wind_speed_m_s,direct_normal_W_m2,"
        "diffuse_W_m2,longwave_down_W_"
        "m2\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format("2026-03-{:02}T{:02}:00:00Z,{},0.5,100000,3,{},0,{}\n", 20 + h / 24,
                               h % 24, air, h > 6 && h < 18 ? given.beam : 0.0, given.longwave);
    }
    write_text(folder / "weather.csv", weather);
    write_text(folder / "mesh.obj", given.mesh);
    const auto material = [&](const char* name, const std::string& layer, const std::string& more) {
        return fmt::format(R"([material.{}]
albedo = {}
emissivity = {}
roughness_length_m = 0.01
layers = [{{ {}, density_kg_m3 = 2000.0, heat_capacity_J_kgK = 500.0 }}]
convection = {{ kind = "constant", value_W_m2K = {} }}
{}
)",
                           name, given.albedo, given.black, layer, film, more);
    };
    write_text(folder / "scene.toml",
               fmt::format(R"([scene]
name = "sheet"
sun_samples = {}
sky_rays = 1024
object_sky_rays = 1024
[terrain]
elevation = "plain.asc"
material = "ground"
[[ground]]
name = "pad"
material = "ground"
rectangle_m = [0.0, 0.0, 30.0, 30.0, 0.0]
largest_edge_m = {}
[[object]]
name = "sheet"
mesh = "mesh.obj"
up = "z"
place_m = [0.0, 0.0]
height_above_ground_m = {}
largest_edge_m = 2.0
material = "sheet"
{}{}[weather]
file = "weather.csv"
interval = "instant"
[atmosphere]
profile = "vacuum"
[time]
start = 2026-03-20T00:00:00Z
frame_every_s = {}
[[observer]]
name = "o"
bands = ["8-12"]
width = 32
height = 32
samples = 4
{})",
                           given.sun_samples, given.ground_edge, given.height,
                           material("ground", "thickness_m = 0.001, conductivity_W_mK = 50.0", ""),
                           material("sheet", given.layer, given.sheet), given.frame_every,
                           given.observer));
}

struct Solved {
    Prepared prepared;
    FacetViews views;
    TemperatureField temperature;

    /// Mean by area over facets of an object (0: the ground) within a distance of the middle that
    /// look up, or down, at an instant of that day [K].
    double kelvin(const std::string& time, bool ground, double from, double to,
                  bool up = true) const {
        const std::vector<float> all =
            temperature.interpolate(parse_instant("2026-03-20T" + time + ":00Z"));
        const FacetSet& facets = prepared.world.facets;
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const double away = double(facets.centroid[f].head<2>().cwiseAbs().maxCoeff());
            if ((f < prepared.world.ground_facets) != ground || away < from || away > to) continue;
            if (up != (facets.normal[f].z() > 0.0f)) continue;
            sum += double(facets.area[f]) * double(all[f]);
            area += double(facets.area[f]);
        }
        return sum / area;
    }
};

inline Solved solved(const Given& given) {
    const ScratchFolder folder("sheet");
    write_scene(folder.path, given);
    Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress silent(ProgressStyle::silent);
    FacetViews views = scene_sky_view(prepared);
    SpanResult result = solve_scene(Stages(prepared), silent);
    return {std::move(prepared), std::move(views), std::move(result.temperature)};
}

}  // namespace diurna::testing::over_plain
