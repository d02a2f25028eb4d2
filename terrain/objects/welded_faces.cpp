#include "terrain/objects/welded_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "terrain/objects/doubled_patches.hpp"

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
WeldedFaces weld_triangles(MeshFile& mesh, std::span<const std::string> material) {
    WeldedFaces found;
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

/// Patches in the place of others that are cut along other lines. What is kept of another material
/// gets the triangles of the first, so that they are back to back.
void weld_patches(MeshFile& mesh, std::span<const std::string> material, WeldedFaces& found) {
    const std::vector<std::uint32_t> of = first_of_material(material);
    std::vector<std::uint8_t> gone(mesh.triangle.size(), 0);
    for (const DoubledPatch& patch : doubled_patches(mesh, of)) {
        const std::uint16_t first = mesh.part_of[patch.first[0]],
                            second = mesh.part_of[patch.second[0]];
        for (const std::uint32_t t : patch.second) gone[t] = 1;
        if (of[first] == of[second]) {
            found.removed += patch.second.size();
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
        }
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (gone[t] != 0) continue;
        mesh.triangle[kept] = Corners{mesh.triangle[t]};
        mesh.part_of[kept++] = std::uint16_t{mesh.part_of[t]};
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
}

}  // namespace

WeldedFaces weld_faces(MeshFile& mesh, std::span<const std::string> material) {
    WeldedFaces found = weld_triangles(mesh, material);
    weld_patches(mesh, material, found);
    return found;
}

}  // namespace diurna
