#include "terrain/objects/doubled_patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace diurna {

namespace {

using Edge = std::array<std::uint32_t, 2>;  // the vertices it goes from and to

struct PatchSide {
    Edge edge;  // ascending
    std::uint32_t triangle;
    bool turned;  // the triangle goes along it from the greater vertex to the lesser
    auto key() const { return std::tuple(edge, triangle); }
};

/// Triangles by their edges, and which of them lie in one plane.
class Sides {
 public:
    explicit Sides(const MeshFile& mesh) {
        normal_.reserve(mesh.triangle.size());
        side_.reserve(3 * mesh.triangle.size());
        for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
            const auto& corner = mesh.triangle[t];
            const Eigen::Vector3d& a = mesh.vertex[corner[0]];
            normal_.push_back(
                (mesh.vertex[corner[1]] - a).cross(mesh.vertex[corner[2]] - a).normalized());
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = corner[k], to = corner[(k + 1) % 3];
                side_.push_back({{std::min(from, to), std::max(from, to)}, t, from > to});
            }
        }
        std::sort(side_.begin(), side_.end(),
                  [](const PatchSide& a, const PatchSide& b) { return a.key() < b.key(); });
    }

    /// Calls body(sides of an edge) for each edge.
    template <class Body>
    void each_edge(const Body& body) const {
        for (std::size_t first = 0, last; first < side_.size(); first = last) {
            for (last = first + 1; last < side_.size() && side_[last].edge == side_[first].edge;) {
                ++last;
            }
            body(std::span(side_).subspan(first, last - first));
        }
    }
    double facing(std::uint32_t a, std::uint32_t b) const { return normal_[a].dot(normal_[b]); }
    bool are_level(std::uint32_t a, std::uint32_t b) const {
        return facing(a, b) > 0.0 && normal_[a].cross(normal_[b]).norm() < 1e-4;
    }
    /// Whether two triangles lie on the same side of their common edge, in one plane.
    bool are_folded(const PatchSide& a, const PatchSide& b) const {
        if (normal_[a.triangle].cross(normal_[b.triangle]).norm() >= 1e-4) return false;
        return (facing(a.triangle, b.triangle) > 0.0) == (a.turned == b.turned);
    }

 private:
    std::vector<Eigen::Vector3d> normal_;  // (triangle) unit
    std::vector<PatchSide> side_;
};

/// (triangle) the least triangle of its patch.
std::vector<std::uint32_t> patches(const Sides& sides, const std::vector<std::uint32_t>& kind) {
    std::vector<std::uint32_t> up(kind.size());
    std::iota(up.begin(), up.end(), 0u);
    const auto top = [&up](std::uint32_t t) {
        while (up[t] != t) t = up[t] = up[up[t]];
        return t;
    };
    sides.each_edge([&](std::span<const PatchSide> edge) {
        // Of two layers the k-th one way goes with the k-th the other way.
        std::vector<std::uint32_t> taken;
        for (const PatchSide& a : edge) {
            if (a.turned) continue;
            for (const PatchSide& b : edge) {
                if (!b.turned || !sides.are_level(a.triangle, b.triangle)) continue;
                if (kind[a.triangle] != kind[b.triangle]) continue;
                if (std::find(taken.begin(), taken.end(), b.triangle) != taken.end()) continue;
                taken.push_back(b.triangle);
                const auto [low, high] = std::minmax({top(a.triangle), top(b.triangle)});
                up[high] = low;
                break;
            }
        }
    });
    for (std::uint32_t t = 0; t < up.size(); ++t) up[t] = top(t);
    return up;
}

/// The border of a patch, each piece once and ascending, without vertices in the midst of it.
std::vector<Edge> border(const MeshFile& mesh, const std::vector<std::uint32_t>& patch) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;
    std::map<std::uint32_t, int> arrive;
    std::vector<Edge> way;
    for (const std::uint32_t t : patch) {
        for (std::size_t k = 0; k < 3; ++k) {
            way.push_back({mesh.triangle[t][k], mesh.triangle[t][(k + 1) % 3]});
        }
    }
    std::sort(way.begin(), way.end());
    for (const Edge& e : way) {
        if (std::binary_search(way.begin(), way.end(), Edge{e[1], e[0]})) continue;
        next[e[0]].push_back(e[1]);
        ++arrive[e[1]];
    }
    const auto is_midst = [&](std::uint32_t from, std::uint32_t at) {
        const auto found = next.find(at);
        if (found == next.end() || found->second.size() != 1 || arrive[at] != 1) return false;
        const Eigen::Vector3d in = mesh.vertex[at] - mesh.vertex[from],
                              out = mesh.vertex[found->second[0]] - mesh.vertex[at];
        return in.dot(out) > 0.0 && in.cross(out).norm() < 1e-6 * in.norm() * out.norm();
    };
    for (auto& [from, to] : next) {
        if (to.size() != 1) continue;
        for (std::size_t left = next.size(); left > 0 && is_midst(from, to[0]); --left) {
            const std::uint32_t midst = to[0];
            to[0] = next.at(midst)[0];
            next.at(midst).clear();
            arrive[midst] = 0;
        }
    }
    std::vector<Edge> pieces;
    for (const auto& [from, to] : next) {
        for (const std::uint32_t v : to) pieces.push_back({std::min(from, v), std::max(from, v)});
    }
    std::sort(pieces.begin(), pieces.end());
    return pieces;
}

/// The corners of a patch's triangles, whichever way they face.
std::vector<std::array<std::uint32_t, 3>> corners(const MeshFile& mesh,
                                                  const std::vector<std::uint32_t>& patch) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const std::uint32_t t : patch) {
        all.push_back(mesh.triangle[t]);
        std::sort(all.back().begin(), all.back().end());
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

std::vector<DoubledPatch> doubled_patches(const MeshFile& mesh,
                                          std::span<const std::uint32_t> material) {
    const Sides sides(mesh);
    std::vector<std::uint8_t> folded(mesh.triangle.size(), 0);
    sides.each_edge([&](std::span<const PatchSide> edge) {
        for (std::size_t i = 0; i < edge.size(); ++i) {
            for (std::size_t j = i + 1; j < edge.size(); ++j) {
                if (!sides.are_folded(edge[i], edge[j])) continue;
                folded[edge[i].triangle] = folded[edge[j].triangle] = 1;
            }
        }
    });
    if (std::find(folded.begin(), folded.end(), 1) == folded.end()) return {};

    std::vector<std::uint32_t> kind;
    for (const std::uint16_t part : mesh.part_of) kind.push_back(material[part]);
    const std::vector<std::uint32_t> of = patches(sides, kind);
    std::map<std::uint32_t, std::vector<std::uint32_t>> patch;
    for (std::uint32_t t = 0; t < of.size(); ++t) patch[of[t]].push_back(t);
    std::map<std::vector<Edge>, std::uint32_t> known;
    std::vector<DoubledPatch> found;
    for (const auto& [least, its] : patch) {
        if (std::none_of(its.begin(), its.end(), [&](auto t) { return folded[t] != 0; })) continue;
        const auto [at, fresh] = known.try_emplace(border(mesh, its), least);
        if (fresh || std::abs(sides.facing(at->second, least)) < 0.99) continue;
        if (corners(mesh, its) == corners(mesh, patch.at(at->second))) continue;
        found.push_back({patch.at(at->second), its, sides.facing(at->second, least) > 0.0});
    }
    return found;
}

}  // namespace diurna
