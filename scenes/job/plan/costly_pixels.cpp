#include "scenes/job/plan/costly_pixels.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "scenes/job/plan/seen_pixels.hpp"

namespace diurna {

namespace {

/// Of its faces that face the camera: a plume is convex.
double pixels_of(const PosedCamera& camera, const Plume& plume) {
    double pixels = 0.0;
    for (const auto& [a, b, c] : plume.triangle) {
        const Eigen::Vector3d &p = plume.vertex[a], &q = plume.vertex[b], &r = plume.vertex[c];
        const Eigen::Vector3d across = (q - p).cross(r - p);
        const double twice = across.norm();
        if (!(twice > 0.0)) continue;
        pixels += camera.pixels_of((p + q + r) / 3.0, across / twice, 0.5 * twice);
    }
    return pixels;
}

double textured_pixels(const PosedCamera& camera, const World& world) {
    const TextureLevels& levels = world.texture_levels;
    double pixels = 0.0;
    for (std::size_t f = 0; f < levels.of_facet.size(); ++f) {
        if (levels.of_facet[f].levels < 2) continue;
        pixels +=
            camera.pixels_of(world.facets.centroid[f].cast<double>(),
                             world.facets.normal[f].cast<double>(), double{world.facets.area[f]});
    }
    return pixels;
}

}  // namespace

CostlyPixels costly_pixels(const World& world, std::span<const Plume> plumes,
                           const ObserverInput& observer, const Sequence& sequence) {
    constexpr std::size_t most = 4;
    const std::size_t count = std::min(most, sequence.pose.size());
    const double all = double(observer.width) * observer.height;
    CostlyPixels mean;
    for (std::size_t k = 0; k < count; ++k) {
        Observer pose = sequence.pose[k * sequence.pose.size() / count];
        pose.width = observer.width;
        pose.height = observer.height;
        const PosedCamera camera(pose);
        double smoke = 0.0;
        for (const Plume& plume : plumes) smoke += pixels_of(camera, plume);
        mean.smoke += std::min(1.0, smoke / all) / double(count);
        mean.textured += std::min(1.0, textured_pixels(camera, world) / all) / double(count);
    }
    return mean;
}

}  // namespace diurna
