#include "terrain/objects/split_rims.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "terrain/objects/cut_polygon.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_rims = 5000;

/// A vertex beside a side of a triangle.
struct Beside {
    double along;  // of the side from its first corner, 0 to 1
    std::uint32_t vertex;
    double distance;
};

/// (triangle, side from corner k to the next) vertices beside it, in its order.
using BesideSides = std::map<std::pair<std::uint32_t, std::size_t>, std::vector<Beside>>;

/// Rims and rows: of a gap near the tolerance of rows either may be one.
std::vector<EdgeSide> open_sides(const MeshPieces& pieces) {
    std::vector<EdgeSide> sides = pieces.rims;
    sides.insert(sides.end(), pieces.rows.begin(), pieces.rows.end());
    return sides;
}

struct RimVertex {
    double x;
    std::uint32_t vertex;
    double shortest;  // edge at it
};

/// Vertices of open edges by their first coordinate.
std::vector<RimVertex> rim_vertices(const MeshFile& mesh, const MeshPieces& pieces) {
    std::map<std::uint32_t, double> shortest;
    for (const EdgeSide& side : open_sides(pieces)) {
        for (const std::uint32_t v : {side.low, side.high}) {
            const double length = (mesh.vertex[side.low] - mesh.vertex[side.high]).norm();
            const auto [known, fresh] = shortest.try_emplace(v, length);
            if (!fresh) known->second = std::min(known->second, length);
        }
    }
    std::vector<RimVertex> rim;
    for (const auto& [vertex, length] : shortest) {
        rim.push_back({mesh.vertex[vertex].x(), vertex, length});
    }
    std::stable_sort(rim.begin(), rim.end(),
                     [](const RimVertex& a, const RimVertex& b) { return a.x < b.x; });
    return rim;
}

BesideSides beside_sides(const MeshFile& mesh, const MeshPieces& pieces, double tolerance) {
    const std::vector<RimVertex> rim = rim_vertices(mesh, pieces);
    BesideSides found;
    for (const EdgeSide& side : open_sides(pieces)) {
        const auto& corner = mesh.triangle[side.triangle];
        std::size_t k = 0;
        while (k < 3 &&
               std::minmax(corner[k], corner[(k + 1) % 3]) != std::minmax(side.low, side.high)) {
            ++k;
        }
        if (k == 3) continue;
        const Eigen::Vector3d a = mesh.vertex[corner[k]],
                              way = mesh.vertex[corner[(k + 1) % 3]] - a;
        const double length = way.norm(), low = std::min(a.x(), a.x() + way.x()) - tolerance,
                     high = std::max(a.x(), a.x() + way.x()) + tolerance;
        auto at = std::lower_bound(rim.begin(), rim.end(), low,
                                   [](const RimVertex& one, double x) { return one.x < x; });
        std::vector<Beside> beside;
        for (; at != rim.end() && at->x <= high; ++at) {
            if (std::find(corner.begin(), corner.end(), at->vertex) != corner.end()) continue;
            const Eigen::Vector3d out = mesh.vertex[at->vertex] - a;
            const double along = out.dot(way) / (length * length);
            const double distance = (out - along * way).norm();
            const bool between =
                along * length > 2.0 * tolerance && (1.0 - along) * length > 2.0 * tolerance;
            if (!between || distance > std::min(tolerance, 0.25 * at->shortest)) continue;
            beside.push_back({along, at->vertex, distance});
        }
        std::sort(beside.begin(), beside.end(),
                  [](const Beside& one, const Beside& other) { return one.along < other.along; });
        if (!beside.empty()) found[{side.triangle, k}] = std::move(beside);
    }
    return found;
}

/// A triangle with the vertices beside its sides as corners, as triangles; itself where it cannot
/// be cut.
std::vector<std::array<std::uint32_t, 3>> cut_at(const MeshFile& mesh, std::uint32_t triangle,
                                                 const BesideSides& sides) {
    std::vector<std::uint32_t> ring;
    std::vector<Eigen::Vector3d> place;
    for (std::size_t k = 0; k < 3; ++k) {
        ring.push_back(mesh.triangle[triangle][k]);
        const auto found = sides.find({triangle, k});
        if (found == sides.end()) continue;
        for (const Beside& one : found->second) ring.push_back(one.vertex);
    }
    if (ring.size() == 3) return {mesh.triangle[triangle]};
    if (ring.size() == 4) {
        // One vertex on one side: two triangles with the corner across from it.
        std::size_t at = 0;
        while (std::find(mesh.triangle[triangle].begin(), mesh.triangle[triangle].end(),
                         ring[at]) != mesh.triangle[triangle].end()) {
            ++at;
        }
        const auto next = [&](std::size_t k) { return ring[(at + k) % 4]; };
        return {{next(3), next(0), next(2)}, {next(0), next(1), next(2)}};
    }
    for (const std::uint32_t v : ring) place.push_back(mesh.vertex[v]);
    const CutPolygon cut = cut_polygon(place);
    std::vector<std::array<std::uint32_t, 3>> cuts;
    for (const auto& [a, b, c] : cut.triangle) cuts.push_back({ring[a], ring[b], ring[c]});
    return cuts.size() + 2 == ring.size() ? cuts : std::vector{mesh.triangle[triangle]};
}

/// The triangles with those of `which` cut, and whose part each is.
struct CutTriangles {
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::vector<std::uint32_t> of;  // (triangle) the one it was
};

CutTriangles cut_triangles(const MeshFile& mesh, const BesideSides& sides,
                           std::span<const std::uint8_t> which) {
    CutTriangles all;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        if (which[t]) {
            for (const auto& one : cut_at(mesh, t, sides)) {
                all.triangle.push_back(one);
                all.of.push_back(t);
            }
        } else {
            all.triangle.push_back(mesh.triangle[t]);
            all.of.push_back(t);
        }
    }
    return all;
}

}  // namespace

SplitRims split_rims(MeshFile& mesh, const MeshPieces& pieces, double tolerance) {
    SplitRims split;
    if (pieces.rims.empty() || pieces.rims.size() > most_rims || !(tolerance > 0.0)) return split;
    const BesideSides sides = beside_sides(mesh, pieces, tolerance);
    if (sides.empty()) return split;
    std::vector<std::uint8_t> which(mesh.triangle.size(), 0), had_rim(mesh.triangle.size(), 0);
    for (const auto& [side, beside] : sides) which[side.first] = 1;
    for (const EdgeSide& side : pieces.rims) had_rim[side.triangle] = 1;
    const CutTriangles trial = cut_triangles(mesh, sides, which);
    const MeshPieces after = mesh_pieces(mesh.vertex, trial.triangle);
    std::vector<std::uint8_t> open(after.size(), 0), fresh(after.size(), 0);
    for (const EdgeSide& side : after.rims) open[after.of[side.triangle]] = 1;
    for (std::size_t t = 0; t < trial.of.size(); ++t) {
        const std::uint32_t piece = after.of[t];
        const bool closes = had_rim[trial.of[t]] && !open[piece] && after.closed[piece];
        if (closes) fresh[piece] = 1;
    }
    std::fill(which.begin(), which.end(), std::uint8_t{0});
    for (std::size_t t = 0; t < trial.of.size(); ++t) {
        if (fresh[after.of[t]]) which[trial.of[t]] = 1;
    }
    for (const auto& [side, beside] : sides) {
        if (!which[side.first]) continue;
        split.vertices += beside.size();
        for (const Beside& one : beside) split.farthest = std::max(split.farthest, one.distance);
    }
    split.closed = std::size_t(std::count(fresh.begin(), fresh.end(), std::uint8_t{1}));
    if (split.closed == 0) return split;
    CutTriangles cut = cut_triangles(mesh, sides, which);
    std::vector<std::uint16_t> part;
    for (const std::uint32_t t : cut.of) part.push_back(mesh.part_of[t]);
    mesh.triangle = std::move(cut.triangle);
    mesh.part_of = std::move(part);
    return split;
}

}  // namespace diurna
