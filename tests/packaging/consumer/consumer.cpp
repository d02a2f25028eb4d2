// The sun of NREL's SPA example (Reda & Andreas 2004, table A5.1: azimuth 194.34024 degrees) and
// the facets of an installed sample scene, by the libraries alone. Exit code 0 if both are there.
#include <cmath>
#include <cstdio>

#include "materials/base/data_folder.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "terrain/place/sun.hpp"

int main() {
    const diurna::Site golden{
        .latitude_deg = 39.742476, .longitude_deg = -105.1786, .height = 1830.14};
    const auto noon = diurna::parse_instant("2003-10-17T12:30:30-07:00");
    const double azimuth = diurna::sun_position(golden, noon).azimuth_deg;
    const auto prepared =
        diurna::prepare(diurna::read_scene(diurna::samples_folder() / "crossover" / "scene.toml"));
    std::printf("azimuth %.5f, observers %zu\n", azimuth, prepared.scene.observers.size());
    return std::abs(azimuth - 194.34024) < 0.001 && !prepared.scene.observers.empty() ? 0 : 1;
}
