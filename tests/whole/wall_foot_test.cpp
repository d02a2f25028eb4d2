#include <fmt/format.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/heat.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/small_scene.hpp"

// A hall on a plain, where nothing emits or reflects: a surface in the beam is warmer than the air
// by what it absorbs over film and conductance to a room of the air's temperature, whatever stands
// beside it; one in the shadow has the air's.

using namespace diurna;

namespace {

constexpr double air = 285.0, film = 8.0, beam = 800.0;
constexpr double through_wall = 1.0 / (0.002 / 1.0 + 1.0 / 10.0);  // [W m⁻² K⁻¹]
constexpr double size = 12.0, height = 5.0;                        // of the hall [m]

/// A plain that rises to the east.
std::string plain(double slope) {
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

std::string thin(const char* name) {
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

Hall hall(double slope) {
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
    SpanResult result = solve_scene(prepared, scene_sky_view(prepared), silent);
    return {std::move(prepared), std::move(result.temperature)};
}

}  // namespace

TEST_CASE("a wall in the sun has one temperature from eaves to foot", "[whole][objects]") {
    const double slope = GENERATE(0.0, 0.07);
    CAPTURE(slope);
    const Hall scene = hall(slope);
    const World& world = scene.prepared.world;
    const Instant noon = parse_instant("2026-03-21T11:00:00Z");
    const Eigen::Vector3d to_sun = sun_direction(sun_position(world.site, noon));
    const std::vector<float> kelvin = scene.temperature.interpolate(noon);
    // The plain as the program has it, beside the hall.
    const auto ground = [&](const Eigen::Vector3f& p) {
        double nearest = 1e9, height_there = 0.0;
        for (std::size_t g = 0; g < world.ground_facets; ++g) {
            const Eigen::Vector3f to = p - world.facets.centroid[g];
            const double distance = to.head<2>().norm();
            if (distance >= nearest) continue;
            nearest = distance;
            const Eigen::Vector3f& n = world.facets.normal[g];
            height_there = p.z() - to.dot(n) / n.z();
        }
        return height_there;
    };
    int walls = 0;
    double lowest = 1e9;
    for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
        const double cosine = world.facets.normal[f].cast<double>().dot(to_sun);
        if (world.facets.normal[f].z() > 0.5f || cosine < 0.1) continue;
        ++walls;
        const auto& centre = world.facets.centroid[f];
        lowest = std::min(lowest, centre.z() - ground(centre));
        CAPTURE(centre.transpose());
        CHECK(kelvin[f] == Approx(air + beam * cosine / (film + through_wall)).margin(0.3));
    }
    CHECK(walls > 50);
    CHECK(lowest > 0.0);   // no facet reaches into the ground
    CHECK(lowest < 0.25);  // and some are seen within a quarter of a metre of it
}

TEST_CASE("a hall casts its shadow on a plain of two triangles", "[whole][objects][sun]") {
    const Hall scene = hall(0.0);
    const World& world = scene.prepared.world;
    const Instant noon = parse_instant("2026-03-21T11:00:00Z");
    const Eigen::Vector3d to_sun = sun_direction(sun_position(world.site, noon));
    const std::vector<float> kelvin = scene.temperature.interpolate(noon);
    // Within the shadow of a box lies what some point of its height at most has towards the sun.
    const auto share_shaded = [&](const Eigen::Vector2d& p) {
        for (int k = 0; k <= 200; ++k) {
            const double up = height * k / 200.0;
            const Eigen::Vector2d at = p + up / to_sun.z() * to_sun.head<2>();
            if (at.cwiseAbs().maxCoeff() < 0.5 * size) return true;
        }
        return false;
    };
    double shadow = 0.0, expected = 0.0;
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        const double lit = air + beam * to_sun.z() / (film + through_wall);
        if (world.facets.centroid[f].head<2>().norm() > 30.0f) continue;
        const double share = (lit - kelvin[f]) / (lit - air);
        shadow += share * world.facets.area[f];
        // The same share from points over the triangle.
        const auto& [a, b, c] = world.facets.corner[f];
        const auto& v = world.facets.vertex;
        int inside = 0;
        for (int i = 0; i < 100; ++i) {
            const double s = std::sqrt((i / 10 + 0.5) / 10.0), t = (i % 10 + 0.5) / 10.0;
            const Eigen::Vector3f p =
                float(1.0 - s) * v[a] + float(s * (1.0 - t)) * v[b] + float(s * t) * v[c];
            inside += share_shaded(p.head<2>().cast<double>());
        }
        expected += world.facets.area[f] * inside / 100.0;
        if (inside == 100) CHECK(kelvin[f] == Approx(air).margin(0.3));
    }
    // A box's shadow beyond it: the plan pushed along its length.
    const Eigen::Vector2d pushed = height / to_sun.z() * to_sun.head<2>();
    CHECK(expected == Approx(size * pushed.cwiseAbs().sum()).epsilon(0.03));
    CHECK(shadow == Approx(expected).epsilon(0.02));
}
