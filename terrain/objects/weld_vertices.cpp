#include "terrain/objects/weld_vertices.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/number_of.hpp"
#include "terrain/objects/mesh_pieces.hpp"
#include "terrain/objects/near_vertices.hpp"
#include "terrain/objects/small_holes.hpp"
#include "terrain/objects/split_rims.hpp"

namespace diurna {

namespace {

using Corners = std::array<std::uint32_t, 3>;

// Shares of the mesh's diagonal.
constexpr double everywhere = 1e-6, nearly = 1e-2;
constexpr std::array along_rims{1e-5, 1e-4, 1e-3};
constexpr double of_sheets = 1e-4;  // the most that is joined where nothing is closed by it

double diagonal(const MeshFile& mesh) {
    Eigen::AlignedBox3d box;
    for (const Corners& corner : mesh.triangle) {
        for (const std::uint32_t v : corner) box.extend(mesh.vertex[v]);
    }
    return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

/// (vertex) the shortest edge at it; -1 where it is no corner of a triangle. An edge up to `needle`
/// long, below a thousandth of another of its triangle, does not count: its ends are one place, and
/// the triangle is a needle between them.
std::vector<double> shortest_edges(const MeshFile& mesh, double needle) {
    constexpr double none = std::numeric_limits<double>::max();
    std::vector<double> shortest(mesh.vertex.size(), none);
    constexpr double of_needle = 1e-3;
    for (const Corners& corner : mesh.triangle) {
        std::array<double, 3> edge{};
        for (std::size_t k = 0; k < 3; ++k) {
            edge[k] = (mesh.vertex[corner[k]] - mesh.vertex[corner[(k + 1) % 3]]).norm();
        }
        const double longest = *std::max_element(edge.begin(), edge.end());
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
            const double length = edge[k];
            if (length == 0.0 || (length <= needle && length < of_needle * longest)) continue;
            shortest[a] = std::min(shortest[a], length);
            shortest[b] = std::min(shortest[b], length);
        }
    }
    for (double& length : shortest) length = length == none ? -1.0 : length;
    return shortest;
}

std::vector<Corners> with_joined(std::span<const Corners> triangle,
                                 std::span<const std::uint32_t> into) {
    std::vector<Corners> joined;
    joined.reserve(triangle.size());
    for (const auto& [a, b, c] : triangle) joined.push_back({into[a], into[b], into[c]});
    return joined;
}

/// Puts vertices in the place of others; triangles that collapse are taken out.
void join(MeshFile& mesh, std::span<const std::uint32_t> into, WeldedVertices& welded) {
    for (std::uint32_t v = 0; v < into.size(); ++v) {
        if (into[v] == v) continue;
        ++welded.joined;
        welded.farthest = std::max(welded.farthest, (mesh.vertex[v] - mesh.vertex[into[v]]).norm());
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto [i, j, k] = mesh.triangle[t];
        const std::uint32_t a = into[i], b = into[j], c = into[k];
        if (a == b || b == c || c == a) {
            ++welded.collapsed;
            continue;
        }
        mesh.triangle[kept] = {a, b, c};
        mesh.part_of[kept++] = std::uint16_t{mesh.part_of[t]};
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
}

/// From an edge to the third corner of a triangle, at right angles to the edge, unit.
Eigen::Vector3d across(std::span<const Eigen::Vector3d> vertex, const Corners& triangle,
                       const EdgeSide& edge) {
    const auto third = std::find_if(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
        return v != edge.low && v != edge.high;
    });
    if (third == triangle.end()) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d along = (vertex[edge.high] - vertex[edge.low]).normalized(),
                          out = vertex[*third] - vertex[edge.low];
    return (out - out.dot(along) * along).normalized();
}

/// (piece) 1 where open edges were joined, none of them so that two triangles lie on each other, as
/// the borders of two sheets that are close would.
std::vector<std::uint8_t> is_smooth(std::span<const Eigen::Vector3d> vertex,
                                    std::span<const Corners> joined, const MeshPieces& pieces,
                                    std::span<const std::uint8_t> had_rims) {
    constexpr double folded = 0.9;  // cosine
    std::vector<std::uint8_t> smooth(pieces.size(), 0), rough(pieces.size(), 0);
    const std::vector<EdgeSide> sides = edge_sides(joined);
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() < 2 || !had_rims[edge[0].triangle] || !had_rims[edge[1].triangle]) return;
        const double cosine = across(vertex, joined[edge[0].triangle], edge[0])
                                  .dot(across(vertex, joined[edge[1].triangle], edge[1]));
        const std::uint32_t piece = pieces.of[edge[0].triangle];
        (cosine > folded || edge.size() > 2 ? rough : smooth)[piece] = 1;
    });
    for (std::size_t p = 0; p < smooth.size(); ++p) smooth[p] &= std::uint8_t(1 - rough[p]);
    return smooth;
}

/// What joining vertices of open edges would do.
struct Trial {
    std::vector<std::uint32_t> into;  // of those alone that close a piece, or go on a sheet
    std::size_t closed = 0;           // pieces that were open
    std::size_t edges = 0;            // of them, that were open
    double farthest = 0.0;
};

/// - sheets: joins open pieces, too, where they go on smoothly
Trial try_rims(const MeshFile& mesh, const MeshPieces& open, std::vector<double> shortest,
               double tolerance, bool sheets) {
    std::vector<std::uint8_t> on_rim(mesh.vertex.size(), 0);
    for (const auto* sides : {&open.rims, &open.rows}) {
        for (const EdgeSide& side : *sides) on_rim[side.low] = on_rim[side.high] = 1;
    }
    for (std::size_t v = 0; v < on_rim.size(); ++v) {
        if (!on_rim[v]) shortest[v] = -1.0;
    }
    Trial trial{.into = near_vertices(mesh.vertex, shortest, tolerance)};
    const std::vector<Corners> joined = with_joined(mesh.triangle, trial.into);
    const MeshPieces pieces = mesh_pieces(mesh.vertex, joined);
    // Pieces that had open edges, or rows, and are closed now.
    std::vector<std::uint8_t> fresh(pieces.size(), 0), was_open(pieces.size(), 0);
    for (const EdgeSide& side : open.rows) fresh[pieces.of[side.triangle]] = 1;
    for (const EdgeSide& side : open.rims) {
        fresh[pieces.of[side.triangle]] = was_open[pieces.of[side.triangle]] = 1;
    }
    const std::vector<PieceBulk> bulk = piece_bulks(mesh.vertex, joined, pieces);
    std::vector<std::uint8_t> had_rims(joined.size(), 0);
    for (const EdgeSide& side : open.rims) had_rims[side.triangle] = 1;
    const std::vector<std::uint8_t> smooth = is_smooth(mesh.vertex, joined, pieces, had_rims);
    std::vector<std::uint8_t> taken(mesh.vertex.size(), 0);
    for (std::size_t p = 0; p < fresh.size(); ++p) {
        if (!pieces.closed[p] || !bulk[p].thicker_than(2.0 * tolerance)) fresh[p] = 0;
        trial.closed += fresh[p] & was_open[p];
    }
    for (std::uint32_t t = 0; t < joined.size(); ++t) {
        const std::uint32_t piece = pieces.of[t];
        const bool goes_on = sheets && !pieces.closed[piece] && smooth[piece];
        if (!fresh[piece] && !goes_on) continue;
        for (const std::uint32_t v : mesh.triangle[t]) taken[v] = 1;
    }
    for (const EdgeSide& rim : open.rims) trial.edges += fresh[pieces.of[rim.triangle]];
    for (std::uint32_t v = 0; v < taken.size(); ++v) {
        if (!taken[v]) trial.into[v] = v;
        trial.farthest =
            std::max(trial.farthest, (mesh.vertex[v] - mesh.vertex[trial.into[v]]).norm());
    }
    return trial;
}

/// Whether each edge has two triangles or more, without rows beside it.
bool is_joined(const MeshPieces& pieces) { return pieces.rims.empty() && pieces.rows.empty(); }

}  // namespace

WeldedVertices weld_vertices(MeshFile& mesh) {
    WeldedVertices welded;
    const double size = diagonal(mesh), needle = everywhere * size;
    join(mesh, near_vertices(mesh.vertex, shortest_edges(mesh, needle), needle), welded);
    MeshPieces pieces = mesh_pieces(mesh.vertex, mesh.triangle);
    for (const double share : along_rims) {
        if (is_joined(pieces)) return welded;
        const Trial trial =
            try_rims(mesh, pieces, shortest_edges(mesh, needle), share * size, share <= of_sheets);
        if (trial.farthest == 0.0) continue;
        welded.closed += trial.closed;
        join(mesh, trial.into, welded);
        pieces = mesh_pieces(mesh.vertex, mesh.triangle);
    }
    if (pieces.rims.empty()) return welded;
    // Corners that lie beside an edge, in place of corners beside corners.
    const SplitRims split = split_rims(mesh, pieces, along_rims.back() * size);
    if (split.closed > 0) {
        welded.split = split.vertices;
        welded.farthest_split = split.farthest;
        welded.closed += split.closed;
        pieces = mesh_pieces(mesh.vertex, mesh.triangle);
        if (pieces.rims.empty()) return welded;
    }
    const Trial trial = try_rims(mesh, pieces, shortest_edges(mesh, needle), nearly * size, false);
    welded.nearly_closed = trial.closed;  // not joined
    welded.gap = trial.closed > 0 ? trial.farthest : 0.0;
    welded.gap_edges = trial.edges;
    if (trial.closed == 0) {
        const SmallHoles holes = small_holes(mesh.vertex, mesh.triangle, pieces);
        welded.nearly_closed = holes.pieces;
        welded.hole_share = holes.share;
    }
    return welded;
}

std::string welded_note(const WeldedVertices& welded) {
    std::string note;
    if (welded.joined > 0) {
        note = fmt::format("{} merged at distances up to {:.2g} (the file's unit)",
                           number_of(welded.joined, "vertex", "vertices"), welded.farthest);
    }
    if (welded.split > 0) {
        note += fmt::format("{}{} merged with an edge at distances up to {:.2g} (the file's unit)",
                            note.empty() ? "" : "; ", number_of(welded.split, "vertex", "vertices"),
                            welded.farthest_split);
    }
    if (note.empty()) return note;
    if (welded.closed > 0)
        note += fmt::format("; {} closed by this", number_of(welded.closed, "piece"));
    if (welded.collapsed > 0) {
        note += fmt::format("; {} without area skipped", number_of(welded.collapsed, "triangle"));
    }
    return note;
}

std::string nearly_closed_warning(const WeldedVertices& welded) {
    if (welded.nearly_closed == 0) return "";
    const std::string pieces =
        welded.nearly_closed == 1
            ? "a piece of its mesh is nearly closed"
            : fmt::format("{} pieces of its mesh are nearly closed", welded.nearly_closed);
    const std::string gap =
        welded.gap > 0.0 ? fmt::format("{} open edges with gaps up to {:.2g} (the file's unit)",
                                       welded.gap_edges, welded.gap)
                         : fmt::format("holes of {:.2g} % of the area", 100.0 * welded.hole_share);
    return fmt::format("{}, with {}: treated as a sheet with two sides", pieces, gap);
}

}  // namespace diurna
