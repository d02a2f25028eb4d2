#include "terrain/objects/mesh_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace diurna {

namespace {

constexpr std::size_t most_compared = 4000;  // open edges: more are no rows beside an edge

/// Sets that grow together (union-find).
class JoinedSets {
 public:
    explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0u); }
    std::uint32_t of(std::uint32_t t) {
        while (up_[t] != t) t = up_[t] = up_[up_[t]];
        return t;
    }
    void join(std::uint32_t a, std::uint32_t b) { up_[of(a)] = of(b); }

 private:
    std::vector<std::uint32_t> up_;
};

/// An edge of one triangle, in the direction in which the triangle goes along it.
struct OpenEdge {
    EdgeSide side;
    Eigen::Vector3d from, to;
    double length = (to - from).norm();
    bool along = false;  // others run along all of it
};

/// The length of `edge` along which `other` lies on the same line.
double length_shared(const OpenEdge& edge, const OpenEdge& other) {
    const Eigen::Vector3d a = other.from - edge.from;
    const double length = edge.length, close = 1e-4 * length, reach = length + other.length;
    if (a.squaredNorm() > reach * reach) return 0.0;
    const Eigen::Vector3d unit = (edge.to - edge.from) / length, b = other.to - edge.from;
    if (a.cross(unit).norm() > close || b.cross(unit).norm() > close) return 0.0;
    const double first = std::min(a.dot(unit), b.dot(unit)),
                 last = std::max(a.dot(unit), b.dot(unit));
    return std::max(0.0, std::min(last, length) - std::max(first, 0.0));
}

/// Rows beside long edges: joins them, and notes edges along all of which others run.
void join_rows(std::span<OpenEdge> open, JoinedSets& sets, std::vector<EdgeJoint>& joints) {
    for (OpenEdge& edge : open) {
        double shared = 0.0;
        for (const OpenEdge& other : open) {
            if (&other == &edge) continue;
            const double length = length_shared(edge, other);
            if (length <= 0.0) continue;
            shared += length;
            sets.join(edge.side.triangle, other.side.triangle);
            const double opposite = (edge.to - edge.from).dot(other.to - other.from);
            if (length > 1e-3 * std::min(edge.length, other.length)) {
                joints.push_back({edge.side.triangle, other.side.triangle, opposite < 0.0});
            }
        }
        edge.along = shared > 0.999 * edge.length;
    }
}

/// The same within each piece alone, of those that have few open edges.
void join_rows_of_pieces(std::vector<OpenEdge>& open, JoinedSets& sets,
                         std::vector<EdgeJoint>& joints) {
    std::vector<std::pair<std::uint32_t, OpenEdge>> by_piece;
    for (const OpenEdge& edge : open) by_piece.emplace_back(sets.of(edge.side.triangle), edge);
    std::stable_sort(by_piece.begin(), by_piece.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = by_piece[i].second;
    for (std::size_t first = 0, last; first < open.size(); first = last) {
        for (last = first + 1;
             last < open.size() && by_piece[last].first == by_piece[first].first;) {
            ++last;
        }
        if (last - first > most_compared) continue;
        join_rows(std::span(open).subspan(first, last - first), sets, joints);
    }
}

}  // namespace

std::vector<EdgeSide> edge_sides(std::span<const std::array<std::uint32_t, 3>> triangle) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * triangle.size());
    for (std::uint32_t t = 0; t < triangle.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle[t][k], b = triangle[t][(k + 1) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, a > b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return sides;
}

MeshPieces mesh_pieces(std::span<const Eigen::Vector3d> vertex,
                       std::span<const std::array<std::uint32_t, 3>> triangle) {
    MeshPieces pieces;
    JoinedSets sets(triangle.size());
    std::vector<OpenEdge> open;
    const std::vector<EdgeSide> sides = edge_sides(triangle);
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        for (const EdgeSide& side : edge) sets.join(edge.front().triangle, side.triangle);
        if (edge.size() == 1) {
            const auto [low, high, t, turned] = edge[0];
            open.push_back({edge[0], vertex[turned ? high : low], vertex[turned ? low : high]});
        } else if (edge.size() == 2) {
            pieces.joints.push_back(
                {edge[0].triangle, edge[1].triangle, edge[0].turned != edge[1].turned});
        }
    });
    if (open.size() <= most_compared) {
        join_rows(open, sets, pieces.joints);
    } else {
        join_rows_of_pieces(open, sets, pieces.joints);
    }

    constexpr auto none = std::uint32_t(-1);
    std::vector<std::uint32_t> number(triangle.size(), none);
    std::uint32_t count = 0;
    pieces.of.resize(triangle.size());
    for (std::uint32_t t = 0; t < triangle.size(); ++t) {
        std::uint32_t& its = number[sets.of(t)];
        if (its == none) its = count++;
        pieces.of[t] = its;
    }
    pieces.closed.assign(count, 1);
    for (const OpenEdge& edge : open) {
        (edge.along ? pieces.rows : pieces.rims).push_back(edge.side);
        if (!edge.along) pieces.closed[pieces.of[edge.side.triangle]] = 0;
    }
    return pieces;
}

MeshPatches mesh_patches(std::size_t triangles, std::span<const EdgeJoint> joints) {
    struct Way {
        std::uint32_t to;
        bool agree;
    };
    std::vector<std::uint32_t> first(triangles + 1, 0);
    for (const auto& [a, b, agree] : joints) ++first[a + 1], ++first[b + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Way> way(first.back());
    std::vector<std::uint32_t> end(first.begin(), first.end() - 1);
    for (const auto& [a, b, agree] : joints) {
        way[end[a]++] = {b, agree};
        way[end[b]++] = {a, agree};
    }
    constexpr auto none = std::uint32_t(-1);
    MeshPatches patches{std::vector(triangles, none), std::vector<std::uint8_t>(triangles, 0), {}};
    std::vector<std::uint32_t> next;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        if (patches.of[t] != none) continue;
        const auto patch = static_cast<std::uint32_t>(patches.sound.size());
        patches.sound.push_back(1);
        patches.of[t] = patch;
        next = {t};
        while (!next.empty()) {
            const std::uint32_t at = next.back();
            next.pop_back();
            for (std::uint32_t w = first[at]; w < first[at + 1]; ++w) {
                const auto turned = std::uint8_t(patches.turned[at] ^ (way[w].agree ? 0 : 1));
                const std::uint32_t to = way[w].to;
                if (patches.of[to] == none) {
                    patches.of[to] = patch;
                    patches.turned[to] = turned;
                    next.push_back(to);
                } else if (patches.turned[to] != turned) {
                    patches.sound[patch] = 0;
                }
            }
        }
    }
    return patches;
}

}  // namespace diurna
