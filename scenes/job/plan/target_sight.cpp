#include "scenes/job/plan/target_sight.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "materials/base/random.hpp"
#include "scenes/job/world/upright_box.hpp"

namespace diurna {

namespace {

constexpr std::size_t sight_points = 256;
constexpr double short_of_target = 0.02;  // [m] of the target that rays end
constexpr float lets_through = 0.05f;     // of the beam

/// From the eye to points of the facets that face it, by their projected areas.
std::vector<Ray> rays_to(const FacetSet& facets, const Eigen::Vector3d& eye) {
    std::vector<double> sum;  // of areas as the eye sees them
    double total = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Eigen::Vector3d to = facets.centroid[f].cast<double>() - eye;
        const double cosine = -to.normalized().dot(facets.normal[f].cast<double>());
        total += double(facets.area[f]) * std::max(0.0, cosine) / to.squaredNorm();
        sum.push_back(total);
    }
    std::vector<Ray> rays;
    if (!(total > 0.0)) return rays;
    for (std::size_t i = 0; i < sight_points; ++i) {
        const double at = (double(i) + 0.5) / double(sight_points) * total;
        const auto f = std::size_t(std::lower_bound(sum.begin(), sum.end(), at) - sum.begin());
        RandomStream chance{hashed(i)};
        const double u = std::sqrt(chance()), v = chance();
        const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
            return facets.vertex[facets.corner[f][k]].cast<double>();
        };
        const Eigen::Vector3d place =
            (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
        const Eigen::Vector3d to = place - eye;
        rays.push_back({.origin = eye.cast<float>(),
                        .direction = to.normalized().cast<float>(),
                        .far = float(std::max(0.0, to.norm() - short_of_target))});
    }
    return rays;
}

}  // namespace

TargetSight target_sight(const World& world, const RayScene& rays, const Observer& observer,
                         const std::string& object) {
    const auto found = std::find(world.objects.begin(), world.objects.end(), object);
    TargetSight sight;
    if (found == world.objects.end()) return sight;
    const auto id = static_cast<ObjectId>(found - world.objects.begin());
    const std::vector<Ray> to = rays_to(object_facets(world, id), observer.position);
    std::vector<Hit> hits(to.size());
    std::vector<float> share(to.size());
    rays.closest(to, hits);
    rays.beam(to, share);
    std::map<std::string, std::size_t> before;
    for (std::size_t i = 0; i < to.size(); ++i) {
        ++sight.facing;
        if (hits[i].facet == no_facet || share[i] >= lets_through) {
            ++sight.seen;
            continue;
        }
        const ObjectId other = hits[i].copy == no_copy ? world.facets.object[index(hits[i].facet)]
                                                       : world.copies[hits[i].copy].object;
        if (other == id) {
            ++sight.seen;
        } else {
            ++before[world.objects[std::size_t(other)]];
        }
    }
    std::size_t most = 0;
    for (const auto& [name, count] : before) {
        if (count <= most) continue;
        most = count;
        sight.hidden_by = name;
    }
    return sight;
}

}  // namespace diurna
