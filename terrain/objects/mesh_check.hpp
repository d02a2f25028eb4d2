#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

namespace diurna {

/// Result of OpenMesh's check of a mesh.
struct MeshCheck {
    std::size_t boundary_edges = 0;
    std::size_t rejected_triangles = 0;  // complex or degenerate: not addable to a manifold
    bool closed() const { return boundary_edges == 0 && rejected_triangles == 0; }
};
MeshCheck check_mesh(std::span<const Eigen::Vector3f> vertex,
                     std::span<const std::array<std::uint32_t, 3>> triangle);

}  // namespace diurna
