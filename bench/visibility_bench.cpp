// Sky view and sun fraction by rays on real relief: time, and rms difference from the same with
// sixteen times as many rays. Beside them the bare rate of occlusion rays, their limit. By the
// processor's own clock, all threads together.

#include "terrain/ground/ground_mesh.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/visibility/hemisphere_rays.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>

#include "materials/base/parallel.hpp"

using namespace diurna;

namespace {

/// Least of three by the processor's own clock, all threads together.
double seconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
    };
    double least = 1e30;
    for (int i = 0; i < 3; ++i) {
        const double start = now();
        work();
        least = std::min(least, now() - start);
    }
    return least;
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
    RayPacket fixed{};
    for (std::size_t k = 0; k < 16; ++k) {
        const Eigen::Vector3f towards =
            direction(22.5 * double(k), 15.0 + 4.0 * double(k)).cast<float>();
        fixed.direction_x[k] = towards.x();
        fixed.direction_y[k] = towards.y();
        fixed.direction_z[k] = towards.z();
    }
    std::vector<std::uint8_t> open(facets.size());
    return seconds([&] {
        for_each_block(facets.size(), 128, [&](std::size_t begin, std::size_t end) {
            RayPacket rays = fixed;
            std::array<std::uint8_t, 16> blocked;
            for (std::size_t f = begin; f < end; ++f) {
                const Eigen::Vector3f from = facets.centroid[f] + 0.01f * facets.normal[f];
                rays.origin_x.fill(from.x());
                rays.origin_y.fill(from.y());
                rays.origin_z.fill(from.z());
                scene.occluded(rays, 16, blocked);
                open[f] = blocked[7];
            }
        });
    });
}

/// The very rays of the sky view, drawn beforehand: what Embree alone needs for them.
double drawn_occlusion(const FacetSet& facets, const RayScene& scene) {
    const HemisphereRays sampler(16, 1);
    std::vector<RayPacket> rays(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) sampler.fill(facets, f, 0, rays[f]);
    std::vector<std::uint8_t> open(facets.size());
    return seconds([&] {
        for_each_block(facets.size(), 128, [&](std::size_t begin, std::size_t end) {
            std::array<std::uint8_t, 16> blocked;
            for (std::size_t f = begin; f < end; ++f) {
                scene.occluded(rays[f], 16, blocked);
                open[f] = blocked[7];
            }
        });
    });
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path file =
        argc > 1 ? argv[1] : DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";
    const FacetSet facets = facets_of(file, 2.0);
    const RayScene scene(facets);
    const auto row = [&](const char* method, const std::string& setting, double cpu, double error) {
        fmt::print("{},{},{},{},{},{:.4f},{:.2g},1\n", file.stem().string(), method, setting,
                   facets.size(), thread_count(), cpu, error);
    };
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    const double fixed = bare_occlusion(facets, scene), drawn = drawn_occlusion(facets, scene);
    row("occluded16", "16 fixed rays", fixed, 0.0);
    row("occluded16", "16 rays of the sky view", drawn, 0.0);

    const FacetViews fine = facet_views(facets, scene, {.rays = 1024, .seed = 7, .others = false});
    for (const int rays : {16, 64, 256}) {
        for (const bool exchange : {false, true}) {
            if (exchange && rays > 64) continue;
            FacetViews view;
            const double cpu = seconds(
                [&] { view = facet_views(facets, scene, {.rays = rays, .others = exchange}); });
            row(exchange ? "sky_view_and_exchange" : "sky_view", fmt::format("{} rays", rays), cpu,
                rms(view.sky, fine.sky));
            fmt::print(stderr, "{} rays{}: {:.1f} M rays/s, {:.0f} % of the best bare rate\n", rays,
                       exchange ? " and exchange" : "", rays * 1e-6 * double(facets.size()) / cpu,
                       100.0 * std::min(fixed, drawn) / cpu * rays / 16);
        }
    }
    // Memory of the exchange against facets: the bytes a facet stay, so the whole is linear.
    for (const double tolerance : {40.0, 20.0, 10.0, 5.0, 2.0}) {
        const FacetSet some = facets_of(file, tolerance);
        const RayScene some_scene(some);
        FacetViews view;
        view = facet_views(some, some_scene, {.rays = 64});
        make_reciprocal(some, view);
        const double bytes = double(view.others.facet.size() * 8 + view.others.row.size() * 4);
        fmt::print("{},exchange_memory,64 rays at {} m,{},{},0,{:.4g},bytes a facet\n",
                   file.stem().string(), tolerance, some.size(), thread_count(),
                   bytes / double(some.size()));
    }
    for (const double elevation_deg : {5.0, 20.0, 45.0}) {
        const Eigen::Vector3d sun = direction(110.0, elevation_deg);
        std::vector<float> exact(facets.size()), fraction(facets.size());
        sun_fraction(facets, scene, sun, exact, {.samples = 64, .seed = 7});
        const double cpu = seconds([&] { sun_fraction(facets, scene, sun, fraction); });
        row("sun_fraction", fmt::format("4 samples at {} deg", elevation_deg), cpu,
            rms(fraction, exact));
    }
}
