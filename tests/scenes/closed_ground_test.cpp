#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <string>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// Ground below a closed box that stands on it sees nothing: no sun, and of longwave what it sends
// itself. Under a constant film its balance is h (T_air - T) = flux into the ground, and of a day
// that repeats, over a bottom that lets nothing through, both means are nothing: whatever the
// ground is made of, its mean is the air's. (Facets across the box's outline, lit on one side of
// it, reflect and send some of that below it: the middle half is asked, on black ground.)
TEST_CASE("ground below a box that stands on it is as warm as the air on the mean",
          "[scenes][closed]") {
    const ScratchFolder folder("closed_ground");
    write_text(folder.path / "crate.obj", crate_mesh);
    for (const char* file : {"level.asc", "level.prj"}) {
        std::filesystem::copy_file(
            std::filesystem::path(DIURNA_SOURCE_DIR "/scenes/crossover") / file,
            folder.path / file);
    }
    const std::string text = R"([scene]
sky_rays = 64
object_sky_rays = 256
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = "level.asc"
radius_m = 150.0
material = "soil"
[material.soil]
albedo = 0.0
emissivity = 0.95
roughness_length_m = 0.01
convection = { kind = "constant", value_W_m2K = 3.0 }
layers = [{ thickness_m = 1.0, conductivity_W_mK = 0.8, density_kg_m3 = 1600.0, heat_capacity_J_kgK = 900.0 }]
[material.shell]
albedo = 0.0
emissivity = 0.9
roughness_length_m = 0.001
convection = { kind = "constant", value_W_m2K = 3.0 }
layers = [{ thickness_m = 0.004, conductivity_W_mK = 45.0, density_kg_m3 = 7800.0, heat_capacity_J_kgK = 500.0 }]
[[object]]
name = "crate"
mesh = "crate.obj"
up = "z"
material = "shell"
place_m = [0.0, 0.0]
ground_edge_m = 0.2
largest_edge_m = 0.3
[weather]
file = ")" DIURNA_SOURCE_DIR R"(/scenes/jacksboro/weather.csv"
interval = "instant"
lapse = 0
[time]
start = 2026-07-15T00:00:00-04:00
step_s = 600.0
frames = ["2026-07-15T12:00:00-04:00"]
[[observer]]
name = "east"
place_m = [60.0, 0.0]
height_above_ground_m = 20.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 24.0
width = 16
height = 12
samples = 4
bands = ["8-12"]
)";
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    const Stages stages(prepared);
    Progress progress(ProgressStyle::silent);
    const SpanResult result = solve_scene(stages, progress);
    CHECK(not_converged(result.report).empty());
    CHECK(result.report.passes <= 8);
    const TemperatureField& field = result.temperature;
    double air = 0.0;
    const std::size_t count = field.instant.size() - 1;  // the last is the first again
    const Weather& weather = prepared.weather;
    for (std::size_t i = 0; i < count; ++i) {
        air += weather.at(field.instant[i]).air.temperature / double(count);
    }
    int below = 0;
    const FacetSet& facets = prepared.world.surfaces();
    for (std::size_t f = 0; f < prepared.world.ground_facets; ++f) {
        const Eigen::Vector3f& at = facets.centroid[f];
        if (std::abs(at.x()) > 1.0f || std::abs(at.y()) > 1.0f) continue;
        double mean = 0.0;
        for (std::size_t i = 0; i < count; ++i) mean += field.at(i)[f] / double(count);
        CHECK(mean == Approx(air).margin(0.05));
        ++below;
    }
    CHECK(below > 3);
}
