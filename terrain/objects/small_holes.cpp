#include "terrain/objects/small_holes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace diurna {

namespace {

/// Open edges that hang together end to end: the rim of a hole.
struct RimHole {
    Eigen::Vector3d area = Eigen::Vector3d::Zero();  // vector, as the patch's first triangle faces
    std::size_t edges = 0;
};

/// (piece) its holes.
std::map<std::uint32_t, std::vector<RimHole>> holes_of(std::span<const Eigen::Vector3d> vertex,
                                                       std::size_t triangles,
                                                       const MeshPieces& pieces) {
    const MeshPatches patches = mesh_patches(triangles, pieces.joints);
    std::map<std::uint32_t, std::vector<std::size_t>> at_vertex;
    for (std::size_t r = 0; r < pieces.rims.size(); ++r) {
        at_vertex[pieces.rims[r].low].push_back(r);
        at_vertex[pieces.rims[r].high].push_back(r);
    }
    std::map<std::uint32_t, std::vector<RimHole>> holes;
    std::vector<std::uint8_t> seen(pieces.rims.size(), 0);
    for (std::size_t r = 0; r < pieces.rims.size(); ++r) {
        if (seen[r]) continue;
        RimHole hole;
        std::vector<std::size_t> next{r};
        seen[r] = 1;
        const Eigen::Vector3d& origin = vertex[pieces.rims[r].low];
        while (!next.empty()) {
            const EdgeSide& rim = pieces.rims[next.back()];
            next.pop_back();
            ++hole.edges;
            const double sign = rim.turned == (patches.turned[rim.triangle] != 0) ? 0.5 : -0.5;
            hole.area += sign * (vertex[rim.low] - origin).cross(vertex[rim.high] - origin);
            for (const std::uint32_t v : {rim.low, rim.high}) {
                for (const std::size_t other : at_vertex[v]) {
                    if (seen[other]) continue;
                    seen[other] = 1;
                    next.push_back(other);
                }
            }
        }
        holes[pieces.of[pieces.rims[r].triangle]].push_back(hole);
    }
    return holes;
}

}  // namespace

std::vector<PieceBulk> piece_bulks(std::span<const Eigen::Vector3d> vertex,
                                   std::span<const std::array<std::uint32_t, 3>> triangle,
                                   const MeshPieces& pieces) {
    const MeshPatches patches = mesh_patches(triangle.size(), pieces.joints);
    constexpr auto none = std::uint32_t(-1);
    std::vector<std::uint32_t> first(pieces.size(), none);
    std::vector<double> volume(patches.sound.size(), 0.0);
    std::vector<std::uint32_t> piece(patches.sound.size(), 0);
    std::vector<PieceBulk> bulk(pieces.size());
    for (std::uint32_t t = 0; t < triangle.size(); ++t) {
        std::uint32_t& origin = first[pieces.of[t]];
        if (origin == none) origin = triangle[t][0];
        const Eigen::Vector3d a = vertex[triangle[t][0]] - vertex[origin],
                              b = vertex[triangle[t][1]] - vertex[origin],
                              c = vertex[triangle[t][2]] - vertex[origin];
        volume[patches.of[t]] += (patches.turned[t] ? -1.0 : 1.0) * a.dot(b.cross(c)) / 6.0;
        piece[patches.of[t]] = pieces.of[t];
        bulk[pieces.of[t]].area += 0.5 * (b - a).cross(c - a).norm();
    }
    for (std::size_t p = 0; p < volume.size(); ++p) bulk[piece[p]].volume += std::abs(volume[p]);
    return bulk;
}

SmallHoles small_holes(std::span<const Eigen::Vector3d> vertex,
                       std::span<const std::array<std::uint32_t, 3>> triangle,
                       const MeshPieces& pieces) {
    SmallHoles found;
    constexpr double few_triangles = 0.1, any = 0.02, bulky = 0.005;
    const std::vector<PieceBulk> bulk = piece_bulks(vertex, triangle, pieces);
    for (const auto& [piece, holes] : holes_of(vertex, triangle.size(), pieces)) {
        const auto& [volume, area] = bulk[piece];
        double open = 0.0;
        std::size_t most_edges = 0;
        for (const RimHole& hole : holes) {
            open += hole.area.norm();
            most_edges = std::max(most_edges, hole.edges);
        }
        const double share = open / area;
        if (share > (most_edges <= 4 ? few_triangles : any)) continue;
        if (volume < bulky * std::pow(area, 1.5)) continue;
        ++found.pieces;
        found.share = std::max(found.share, share);
    }
    return found;
}

}  // namespace diurna
