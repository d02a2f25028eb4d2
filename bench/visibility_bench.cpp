// Sky view and sun fraction by rays on real relief: time, and rms difference from the same with
// sixteen times as many rays. Beside them the bare rate of occlusion rays, their limit.

#include "terrain/visibility.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>

#include "terrain/ground_mesh.hpp"
#include "terrain/parallel.hpp"

using namespace diurna;

namespace {

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double rms(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

FacetSet facets_of(const std::filesystem::path& file, double tolerance) {
    const Dem dem = read_dem(file, {.voids = VoidPolicy::leave});
    const GroundMesh mesh = ground_mesh(dem, tolerance);
    const Geodetic centre = dem_centre(dem);
    const Site site{centre.latitude_deg, centre.longitude_deg, centre.height};
    FacetSet facets;
    append_facets(facets, local_vertices(dem, site, mesh.place, mesh.height), mesh.triangle,
                  std::vector<MaterialId>(mesh.triangle.size()), ObjectId{0});
    return facets;
}

/// Sixteen fixed directions over the sky from each centroid: nothing but Embree and its packets.
double bare_occlusion(const FacetSet& facets, const RayScene& scene) {
    std::vector<Ray> rays;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (int k = 0; k < 16; ++k) {
            rays.push_back({.origin = facets.centroid[f] + 0.01f * facets.normal[f],
                            .direction = direction(22.5 * k, 15.0 + 4.0 * k).cast<float>()});
        }
    }
    std::vector<std::uint8_t> blocked(rays.size());
    return seconds([&] {
        for_each_block(rays.size(), 4096, [&](std::size_t begin, std::size_t end) {
            scene.occluded(std::span(rays).subspan(begin, end - begin),
                           std::span(blocked).subspan(begin, end - begin), Coherence::incoherent);
        });
    });
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path file =
        argc > 1 ? argv[1] : DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";
    const FacetSet facets = facets_of(file, 2.0);
    const RayScene scene(facets);
    const auto row = [&](const char* method, const std::string& setting, double wall,
                         double error) {
        fmt::print("{},{},{},{},{},{:.4f},{:.2g},1\n", file.stem().string(), method, setting,
                   facets.size(), thread_count(), wall, error);
    };
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    row("occluded16", "16 bare rays", bare_occlusion(facets, scene), 0.0);

    const SkyView fine = sky_view(facets, scene, {.rays = 1024, .seed = 7});
    for (const int rays : {16, 64, 256}) {
        SkyView view;
        const double wall = seconds([&] { view = sky_view(facets, scene, {.rays = rays}); });
        row("sky_view", fmt::format("{} rays", rays), wall, rms(view.sky_view, fine.sky_view));
    }
    for (const double elevation_deg : {5.0, 20.0, 45.0}) {
        const Eigen::Vector3d sun = direction(110.0, elevation_deg);
        std::vector<float> exact(facets.size()), fraction(facets.size());
        sun_fraction(facets, scene, sun, exact, {.samples = 64, .seed = 7});
        const double wall = seconds([&] { sun_fraction(facets, scene, sun, fraction); });
        row("sun_fraction", fmt::format("4 samples at {} deg", elevation_deg), wall,
            rms(fraction, exact));
    }
}
