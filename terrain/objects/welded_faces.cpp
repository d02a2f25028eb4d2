#include "terrain/objects/welded_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "terrain/objects/doubled_patches.hpp"
#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The same for triangles with the same corners.
Corners ascending(Corners corner) {
    std::sort(corner.begin(), corner.end());
    return corner;
}

/// Whether two triangles of the same corners face the same way.
bool face_alike(const Corners& a, const Corners& b) {
    const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return b[std::size_t(at + 1) % 3] == a[1];
}

bool is_flat(const MeshFile& mesh, const Corners& corner) {
    const Eigen::Vector3d &a = mesh.vertex[corner[0]], &b = mesh.vertex[corner[1]],
                          &c = mesh.vertex[corner[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return !((b - a).cross(c - a).norm() > 1e-9 * longest * longest);
}

/// Triangles with the same corners as others, and flat ones.
///
/// - doubled: (triangle) gets 1 of those that another of the same material lay on
WeldedFaces weld_triangles(MeshFile& mesh, std::span<const std::string> material,
                           std::vector<std::uint8_t>& doubled) {
    WeldedFaces found;
    doubled.assign(mesh.triangle.size(), 0);
    std::map<Corners, std::uint32_t> first;
    std::uint32_t kept = 0;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        const Corners corner = mesh.triangle[t];
        if (is_flat(mesh, corner)) {
            ++found.flat;
            continue;
        }
        const auto [known, fresh] = first.try_emplace(ascending(corner), kept);
        if (!fresh) {
            const bool same = material[mesh.part_of[known->second]] == material[mesh.part_of[t]];
            if (same) {
                ++found.removed;
                doubled[known->second] = 1;
                continue;
            }
            if (face_alike(mesh.triangle[known->second], corner) && !found.contested) {
                found.contested = {mesh.part_of[known->second], mesh.part_of[t]};
            }
            ++found.back_to_back;
        }
        mesh.triangle[kept] = corner;
        mesh.part_of[kept] = mesh.part_of[t];
        ++kept;
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
    doubled.resize(kept);
    return found;
}

/// (part) the first part of its material.
std::vector<std::uint32_t> first_of_material(std::span<const std::string> material) {
    std::vector<std::uint32_t> first;
    for (const std::string& name : material) {
        first.push_back(static_cast<std::uint32_t>(
            std::find(material.begin(), material.end(), name) - material.begin()));
    }
    return first;
}

/// Takes out the triangles that are marked.
void take_out(const std::vector<std::uint8_t>& gone, MeshFile& mesh,
              std::vector<std::uint8_t>& doubled) {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (gone[t] != 0) continue;
        doubled[kept] = std::uint8_t{doubled[t]};
        mesh.triangle[kept] = Corners{mesh.triangle[t]};
        mesh.part_of[kept++] = std::uint16_t{mesh.part_of[t]};
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
    doubled.resize(kept);
}

/// Patches in the place of others that are cut along other lines. What is kept of another material
/// gets the triangles of the first, so that they are back to back.
void weld_patches(MeshFile& mesh, std::span<const std::string> material, WeldedFaces& found,
                  std::vector<std::uint8_t>& doubled) {
    const std::vector<std::uint32_t> of = first_of_material(material);
    std::vector<std::uint8_t> gone(mesh.triangle.size(), 0);
    for (const DoubledPatch& patch : doubled_patches(mesh, of)) {
        const std::uint16_t first = mesh.part_of[patch.first[0]],
                            second = mesh.part_of[patch.second[0]];
        for (const std::uint32_t t : patch.second) gone[t] = 1;
        if (of[first] == of[second]) {
            found.removed += patch.second.size();
            for (const std::uint32_t t : patch.first) doubled[t] = 1;
            continue;
        }
        if (patch.face_alike && !found.contested) found.contested = {first, second};
        found.back_to_back += patch.first.size();
        for (const std::uint32_t t : patch.first) {
            Corners reversed = mesh.triangle[t];
            if (!patch.face_alike) std::swap(reversed[1], reversed[2]);
            mesh.triangle.push_back(reversed);
            mesh.part_of.push_back(second);
            gone.push_back(0);
            doubled.push_back(0);
        }
    }
    take_out(gone, mesh, doubled);
}

/// Squares in the place of others, cut along the other diagonal, where bodies touch: the files of
/// some have bodies that face inwards among others, so that the patches of a wall and of its copy
/// go on differently (weld_patches). Along each side of such a square run three triangles or more.
void weld_squares(MeshFile& mesh, std::span<const std::string> material, WeldedFaces& found,
                  std::vector<std::uint8_t>& doubled) {
    const std::vector<EdgeSide> sides = edge_sides(mesh.triangle);
    std::vector<std::uint8_t> crowded(mesh.triangle.size(), 0);  // edges of three and more
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() < 3) return;
        for (const EdgeSide& side : edge) ++crowded[side.triangle];
    });
    const auto normal = [&](std::uint32_t t) -> Eigen::Vector3d {
        const auto& [a, b, c] = mesh.triangle[t];
        return (mesh.vertex[b] - mesh.vertex[a])
            .cross(mesh.vertex[c] - mesh.vertex[a])
            .normalized();
    };
    std::map<std::array<std::uint32_t, 4>, std::array<std::uint32_t, 2>> first;
    std::vector<std::uint8_t> gone(mesh.triangle.size(), 0);
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        if (edge.size() != 2) return;
        const std::uint32_t a = edge[0].triangle, b = edge[1].triangle;
        if (crowded[a] < 2 || crowded[b] < 2 || normal(a).cross(normal(b)).norm() > 1e-4) return;
        std::array<std::uint32_t, 4> corners{edge[0].low, edge[0].high, 0, 0};
        for (std::size_t k = 0; k < 2; ++k) {
            for (const std::uint32_t v : mesh.triangle[edge[k].triangle]) {
                if (v != edge[0].low && v != edge[0].high) corners[2 + k] = v;
            }
        }
        std::sort(corners.begin(), corners.end());
        const auto [known, fresh] = first.try_emplace(corners, std::array{a, b});
        if (fresh) return;
        const auto& [c, d] = known->second;
        const std::string& name = material[mesh.part_of[a]];
        for (const std::uint32_t t : {b, c, d}) {
            if (material[mesh.part_of[t]] != name) return;
        }
        if (gone[a] || gone[b] || gone[c] || gone[d]) return;
        gone[a] = gone[b] = 1;
        doubled[c] = doubled[d] = 1;
        found.removed += 2;
    });
    take_out(gone, mesh, doubled);
}

/// Takes out, of the triangles that lay there twice, patches that are walls between bodies.
void drop_inner_walls(MeshFile& mesh, std::vector<std::uint8_t> doubled, WeldedFaces& found) {
    if (std::find(doubled.begin(), doubled.end(), std::uint8_t{1}) == doubled.end()) return;
    // Patches of doubled triangles that have edges in common.
    std::vector<std::uint32_t> patch(mesh.triangle.size());
    std::iota(patch.begin(), patch.end(), 0u);
    const auto root = [&](std::uint32_t t) {
        while (patch[t] != t) t = patch[t] = patch[patch[t]];
        return t;
    };
    const std::vector<EdgeSide> sides = edge_sides(mesh.triangle);
    const auto is_doubled = [&](const EdgeSide& side) { return doubled[side.triangle] != 0; };
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        const auto first = std::find_if(edge.begin(), edge.end(), is_doubled);
        for (const EdgeSide& side : edge) {
            if (is_doubled(side)) patch[root(side.triangle)] = root(first->triangle);
        }
    });
    std::vector<std::uint8_t> is_sheet(patch.size(), 0), is_joined(patch.size(), 0);
    each_edge(sides, [&](std::span<const EdgeSide> edge) {
        const auto walls = std::count_if(edge.begin(), edge.end(), is_doubled);
        if (walls == 0) return;
        const auto others = std::ptrdiff_t(edge.size()) - walls;
        const std::uint32_t of = root(std::find_if(edge.begin(), edge.end(), is_doubled)->triangle);
        if (others % 2 != 0 || (others == 0 && walls < 2)) is_sheet[of] = 1;
        if (others > 0) is_joined[of] = 1;
    });
    std::size_t kept = 0;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        if (doubled[t] && !is_sheet[root(t)] && is_joined[root(t)]) {
            ++found.inner;
            continue;
        }
        mesh.triangle[kept] = Corners{mesh.triangle[t]};
        mesh.part_of[kept++] = std::uint16_t{mesh.part_of[t]};
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
}

}  // namespace

WeldedFaces weld_faces(MeshFile& mesh, std::span<const std::string> material) {
    std::vector<std::uint8_t> doubled;
    WeldedFaces found = weld_triangles(mesh, material, doubled);
    weld_patches(mesh, material, found, doubled);
    weld_squares(mesh, material, found, doubled);
    drop_inner_walls(mesh, std::move(doubled), found);
    return found;
}

}  // namespace diurna
