#include "terrain/objects/facing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "materials/base/number_of.hpp"
#include "terrain/objects/line_grid.hpp"
#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

namespace {

constexpr auto no_solid = std::size_t(-1);

/// No line in one of these directions runs along faces of what people draw.
const std::array<Eigen::Vector3d, 3>& general_directions() {
    static const std::array<Eigen::Vector3d, 3> directions{
        Eigen::Vector3d(0.3217, 0.5631, 0.7612).normalized(),
        Eigen::Vector3d(-0.7129, 0.4213, 0.5601).normalized(),
        Eigen::Vector3d(0.6173, -0.6841, 0.3889).normalized()};
    return directions;
}

/// A patch of a closed piece.
struct Solid {
    std::vector<std::uint32_t> triangle;
    Eigen::AlignedBox3d box;
    double volume = 0.0, area = 0.0, turned_area = 0.0;  // of the patch as its first triangle faces
    bool whole = true;                                   // encloses something by itself
    int as_in_file = 1;    // sign of the volume as most of its area is in the file
    int facing = 1;        // the sign that the volume shall have
    std::string material;  // "": several
    std::size_t within = no_solid;
};

/// The faces of each solid, with volume, area and material.
std::vector<Solid> solids_of(const MeshFile& mesh, const MeshPieces& pieces,
                             const MeshPatches& patches, std::span<const std::string> material) {
    std::vector<Solid> solids(patches.sound.size());
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        if (!pieces.closed[pieces.of[t]]) continue;
        Solid& solid = solids[patches.of[t]];
        const auto& [i, j, k] = mesh.triangle[t];
        const std::string& own = material[mesh.part_of[t]];
        if (solid.triangle.empty()) solid.material = own;
        if (solid.material != own) solid.material.clear();
        solid.triangle.push_back(t);
        const Eigen::Vector3d& origin = mesh.vertex[mesh.triangle[solid.triangle[0]][0]];
        const Eigen::Vector3d a = mesh.vertex[i] - origin, b = mesh.vertex[j] - origin,
                              c = mesh.vertex[k] - origin;
        const double sign = patches.turned[t] ? -1.0 : 1.0,
                     area = 0.5 * (b - a).cross(c - a).norm();
        solid.volume += sign * a.dot(b.cross(c)) / 6.0;
        solid.area += area;
        if (patches.turned[t]) solid.turned_area += area;
        for (const std::uint32_t v : {i, j, k}) solid.box.extend(mesh.vertex[v]);
    }
    for (Solid& solid : solids) {
        const bool most_turned = solid.turned_area > 0.5 * solid.area;
        solid.as_in_file = (solid.volume < 0.0) == most_turned ? 1 : -1;
    }
    return solids;
}

/// A patch is no whole where it has one triangle at an edge that it shares with others.
void find_walls(const MeshFile& mesh, const MeshPatches& patches, std::vector<Solid>& solids) {
    const std::vector<EdgeSide> sides = edge_sides(mesh.triangle);
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() < 3) return;
        std::map<std::uint32_t, int> count;
        for (const EdgeSide& side : edge) ++count[patches.of[side.triangle]];
        for (const auto& [patch, times] : count) {
            if (times % 2 != 0) solids[patch].whole = false;
        }
    });
}

bool encloses_volume(const Solid& solid) {
    return std::abs(solid.volume) > 1e-9 * std::pow(solid.area, 1.5);
}

/// Middles of some triangles, spread over a solid.
std::vector<Eigen::Vector3d> samples_of(const MeshFile& mesh, const Solid& solid) {
    constexpr std::size_t most = 7;
    std::vector<Eigen::Vector3d> samples;
    const std::size_t count = std::min(most, solid.triangle.size());
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [a, b, c] = mesh.triangle[solid.triangle[i * solid.triangle.size() / count]];
        samples.push_back((mesh.vertex[a] + mesh.vertex[b] + mesh.vertex[c]) / 3.0);
    }
    return samples;
}

/// Which solid lies within which: the smallest that encloses it. Then the way each shall face.
void nest(const MeshFile& mesh, std::vector<Solid>& solids) {
    std::vector<std::size_t> order;  // from the largest to the smallest
    for (std::size_t s = 0; s < solids.size(); ++s) {
        if (!solids[s].triangle.empty() && solids[s].whole && encloses_volume(solids[s])) {
            order.push_back(s);
        }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(solids[a].volume) > std::abs(solids[b].volume);
    });
    std::vector<std::optional<LineGrid>> columns(solids.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        Solid& inner = solids[order[i]];
        const std::vector<Eigen::Vector3d> samples = samples_of(mesh, inner);
        for (std::size_t k = i; k-- > 0 && inner.within == no_solid;) {
            const Solid& outer = solids[order[k]];
            if (!outer.box.contains(inner.box)) continue;
            std::optional<LineGrid>& grid = columns[order[k]];
            if (!grid) {
                grid.emplace(mesh.vertex, mesh.triangle, outer.triangle, general_directions()[0]);
            }
            const bool inside = std::all_of(
                samples.begin(), samples.end(),
                [&](const Eigen::Vector3d& point) { return grid->crossed(point).ahead % 2 == 1; });
            if (inside) inner.within = order[k];
        }
        if (inner.within == no_solid) continue;
        const Solid& outer = solids[inner.within];
        const bool alike = !inner.material.empty() && inner.material == outer.material;
        inner.facing = alike ? -outer.facing : outer.facing * inner.as_in_file * outer.as_in_file;
    }
}

/// Of patches that share walls with others: more than 0 where lines from the side that the first
/// triangle faces reach the outside, less where those from the other do, 0 where none can say.
double seen_from_outside(const MeshFile& mesh, const MeshPatches& patches, const Solid& patch,
                         std::span<const LineGrid> columns) {
    constexpr std::size_t most = 32;
    double vote = 0.0;
    const std::size_t count = std::min(most, patch.triangle.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t t = patch.triangle[i * patch.triangle.size() / count];
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3d normal =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
        const Eigen::Vector3d middle = (mesh.vertex[a] + mesh.vertex[b] + mesh.vertex[c]) / 3.0;
        for (std::size_t d = 0; d < columns.size(); ++d) {
            const auto [ahead, behind] = columns[d].crossed(middle, t);
            if ((ahead == 0) == (behind == 0)) continue;
            const double faces = normal.dot(general_directions()[d]) * (ahead == 0 ? 1.0 : -1.0);
            vote += patches.turned[t] ? -faces : faces;
        }
    }
    return vote;
}

}  // namespace

Facing turn_outward(MeshFile& mesh, std::span<const std::string> material) {
    const MeshPieces pieces = mesh_pieces(mesh.vertex, mesh.triangle);
    Facing found;
    found.closed = std::size_t(std::count(pieces.closed.begin(), pieces.closed.end(), 1));
    if (found.closed == 0) return found;
    const MeshPatches patches = mesh_patches(mesh.triangle.size(), pieces.joints);
    std::vector<Solid> solids = solids_of(mesh, pieces, patches, material);
    find_walls(mesh, patches, solids);
    nest(mesh, solids);

    std::map<std::uint32_t, std::vector<std::uint32_t>> shared;  // pieces with walls: triangles
    for (const Solid& solid : solids) {
        if (!solid.triangle.empty() && !solid.whole) shared[pieces.of[solid.triangle[0]]];
    }
    for (std::uint32_t t = 0; t < pieces.of.size() && !shared.empty(); ++t) {
        if (const auto at = shared.find(pieces.of[t]); at != shared.end()) at->second.push_back(t);
    }
    std::map<std::uint32_t, std::vector<LineGrid>> columns;
    for (const auto& [piece, triangles] : shared) {
        for (const Eigen::Vector3d& direction : general_directions()) {
            columns[piece].emplace_back(mesh.vertex, mesh.triangle, triangles, direction);
        }
    }

    for (std::size_t s = 0; s < solids.size(); ++s) {
        Solid& solid = solids[s];
        if (solid.triangle.empty() || !patches.sound[s]) continue;
        bool invert = false;  // of the sense of its first triangle
        if (!solid.whole) {
            const double vote =
                seen_from_outside(mesh, patches, solid, columns.at(pieces.of[solid.triangle[0]]));
            invert = vote < 0.0 || (vote == 0.0 && solid.turned_area > 0.5 * solid.area);
        } else if (encloses_volume(solid)) {
            invert = (solid.volume > 0.0) != (solid.facing > 0);
        } else {
            continue;
        }
        std::size_t count = 0;
        for (const std::uint32_t t : solid.triangle) {
            if ((patches.turned[t] != 0) == invert) continue;
            std::swap(mesh.triangle[t][1], mesh.triangle[t][2]);
            ++count;
        }
        const double turned_area = invert ? solid.area - solid.turned_area : solid.turned_area;
        if (turned_area > 0.5 * solid.area) {
            ++found.turned;
            found.triangles += solid.triangle.size() - count;
        } else {
            found.triangles += count;
        }
        if (solid.within != no_solid && solid.facing < 0) ++found.cavities;
    }
    return found;
}

std::string facing_note(const Facing& facing) {
    std::string note;
    if (facing.turned > 0) {
        note = fmt::format("{} of {} closed pieces reversed to face outwards", facing.turned,
                           facing.closed);
        if (facing.cavities > 0) {
            note += fmt::format(" ({} of them {} inside another piece)", facing.cavities,
                                facing.cavities > 1 ? "are cavities" : "is");
        }
    }
    if (facing.triangles > 0) {
        note += fmt::format("{}{} of closed pieces reversed to face as the neighbours",
                            note.empty() ? "" : "; ", number_of(facing.triangles, "triangle"));
    }
    return note;
}

}  // namespace diurna
