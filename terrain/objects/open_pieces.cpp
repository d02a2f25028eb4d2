#include "terrain/objects/open_pieces.hpp"

#include <array>
#include <map>

#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

namespace {

/// The same number for vertices at the same place.
std::vector<std::uint32_t> places(const std::vector<Eigen::Vector3f>& vertex) {
    std::map<std::array<float, 3>, std::uint32_t> known;
    std::vector<std::uint32_t> place;
    for (std::uint32_t v = 0; v < vertex.size(); ++v) {
        const Eigen::Vector3f& at = vertex[v];
        place.push_back(known.try_emplace({at.x(), at.y(), at.z()}, v).first->second);
    }
    return place;
}

}  // namespace

std::vector<std::uint8_t> open_pieces(const ObjectMesh& mesh) {
    const std::vector<std::uint32_t> place = places(mesh.vertex);
    std::vector<Eigen::Vector3d> vertex;
    for (const Eigen::Vector3f& at : mesh.vertex) vertex.push_back(at.cast<double>());
    std::vector<std::array<std::uint32_t, 3>> triangle;
    for (const auto& [a, b, c] : mesh.triangle) triangle.push_back({place[a], place[b], place[c]});
    const MeshPieces pieces = mesh_pieces(vertex, triangle);
    std::vector<std::uint8_t> open;
    for (const std::uint32_t piece : pieces.of) open.push_back(pieces.closed[piece] ? 0 : 1);
    return open;
}

}  // namespace diurna
