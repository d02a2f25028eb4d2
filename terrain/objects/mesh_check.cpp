#include "terrain/objects/mesh_check.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_cast.hh>
#include <vector>

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

std::size_t count_components(const HalfEdges& mesh) {
    std::vector<bool> seen(mesh.n_faces(), false);
    std::vector<OpenMesh::FaceHandle> stack;
    std::size_t components = 0;
    for (const auto start : mesh.faces()) {
        if (seen[static_cast<std::size_t>(start.idx())]) continue;
        ++components;
        seen[static_cast<std::size_t>(start.idx())] = true;
        stack.push_back(start);
        while (!stack.empty()) {
            const auto face = stack.back();
            stack.pop_back();
            for (auto it = mesh.cff_iter(face); it.is_valid(); ++it) {
                const auto next = static_cast<std::size_t>(it->idx());
                if (seen[next]) continue;
                seen[next] = true;
                stack.push_back(*it);
            }
        }
    }
    return components;
}

}  // namespace

MeshCheck check_mesh(std::span<const Eigen::Vector3f> vertex,
                     std::span<const std::array<std::uint32_t, 3>> triangle) {
    const QuietOpenMesh quiet;
    HalfEdges mesh;
    mesh.reserve(vertex.size(), vertex.size() + triangle.size(), triangle.size());
    for (const auto& v : vertex) mesh.add_vertex({v.x(), v.y(), v.z()});
    MeshCheck result;
    result.vertices = vertex.size();
    result.triangles = triangle.size();
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
    result.components = count_components(mesh);
    return result;
}

}  // namespace diurna
