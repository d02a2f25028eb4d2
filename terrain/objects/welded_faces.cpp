#include "terrain/objects/welded_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

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

}  // namespace

WeldedFaces weld_faces(MeshFile& mesh, std::span<const std::string> material) {
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

}  // namespace diurna
