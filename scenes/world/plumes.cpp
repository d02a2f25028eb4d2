#include "scenes/world/plumes.hpp"

namespace diurna {

Plume plume_at(const PlumeInput& input, const Eigen::Vector3d& ground) {
    constexpr int sides = 24;
    const Eigen::Vector3d foot = ground + Eigen::Vector3d(0.0, 0.0, input.height_above_ground);
    return {.name = input.name,
            .vertex = frustum_vertices(foot, input.radius, input.top_radius, input.height,
                                       input.lean, sides),
            .triangle = frustum_triangles(sides),
            .absorption = input.absorption,
            .temperature = input.temperature};
}

}  // namespace diurna
