#include "terrain/objects/mesh_check.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_cast.hh>

namespace diurna {

namespace {

using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<>;

/// OpenMesh reports each face it refuses on its own error stream: silence it for a while.
class QuietOpenMesh {
 public:
    QuietOpenMesh() : enabled_(omerr().is_enabled()) { omerr().disable(); }
    ~QuietOpenMesh() {
        if (enabled_) omerr().enable();
    }
    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
    bool enabled_;
};

}  // namespace

MeshCheck check_mesh(std::span<const Eigen::Vector3f> vertex,
                     std::span<const std::array<std::uint32_t, 3>> triangle) {
    const QuietOpenMesh quiet;
    HalfEdges mesh;
    mesh.reserve(vertex.size(), vertex.size() + triangle.size(), triangle.size());
    for (const auto& v : vertex) mesh.add_vertex({v.x(), v.y(), v.z()});
    MeshCheck result;
    for (const auto& [a, b, c] : triangle) {
        const bool valid = a < vertex.size() && b < vertex.size() && c < vertex.size() && a != b &&
                           b != c && c != a;
        const auto handle = [](std::uint32_t i) {
            return OpenMesh::VertexHandle(static_cast<int>(i));
        };
        if (!valid || !mesh.add_face(handle(a), handle(b), handle(c)).is_valid()) {
            ++result.rejected_triangles;
        }
    }
    for (const auto edge : mesh.edges()) result.boundary_edges += mesh.is_boundary(edge) ? 1 : 0;
    return result;
}

}  // namespace diurna
