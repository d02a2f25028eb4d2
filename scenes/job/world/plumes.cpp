#include "scenes/job/world/plumes.hpp"

namespace diurna {

Plume plume_at(const PlumeInput& input, const Eigen::Vector3d& foot) {
    constexpr int sides = 24;
    return {.name = input.name,
            .vertex = frustum_vertices(foot, input.radius, input.top_radius, input.height,
                                       input.lean, sides),
            .triangle = frustum_triangles(sides),
            .absorption = input.absorption,
            .temperature = input.temperature};
}

}  // namespace diurna
