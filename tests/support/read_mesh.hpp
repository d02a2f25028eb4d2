#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "terrain/objects/facing.hpp"
#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/welded_faces.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_scene.hpp"

// Meshes as a scene reads them, and what can be known of them by hand.

namespace read_mesh {

using namespace diurna;

inline MeshFile file_of(const std::string& name, const std::string& text) {
    const ScratchFolder folder("mesh");
    write_text(folder.path / name, text);
    return read_mesh_file(folder.path / name);
}

inline std::vector<std::string> one_material(const MeshFile& mesh) {
    return std::vector<std::string>(mesh.part.size(), "tin");
}

/// Turned outward, as an object of one material.
inline MeshFile outward(MeshFile mesh) {
    turn_outward(mesh, one_material(mesh));
    return mesh;
}

inline double volume(const MeshFile& mesh) {
    double sum = 0.0;
    const Eigen::Vector3d origin = mesh.vertex.at(0);
    for (const auto& [a, b, c] : mesh.triangle) {
        sum += (mesh.vertex[a] - origin)
                   .dot((mesh.vertex[b] - origin).cross(mesh.vertex[c] - origin)) /
               6.0;
    }
    return sum;
}

inline double area(const MeshFile& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangle) {
        sum +=
            0.5 * (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]).norm();
    }
    return sum;
}

inline Eigen::Vector3d size(const MeshFile& mesh) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : mesh.vertex) box.extend(v);
    return box.sizes();
}

/// A box of 12 triangles; volume size³.
struct Box {
    Eigen::Vector3d low;
    Eigen::Vector3d sides{1.0, 1.0, 1.0};
    bool inside_out = false;

    std::vector<std::array<Eigen::Vector3d, 3>> triangles() const {
        std::array<Eigen::Vector3d, 8> corner;
        for (int k = 0; k < 8; ++k) {
            corner[std::size_t(k)] =
                low + Eigen::Vector3d((k & 1) * sides.x(), (k >> 1 & 1) * sides.y(),
                                      (k >> 2) * sides.z());
        }
        std::vector<std::array<Eigen::Vector3d, 3>> all;
        for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1},
                                         {4, 5, 7, 6},
                                         {0, 1, 5, 4},
                                         {1, 3, 7, 5},
                                         {3, 2, 6, 7},
                                         {2, 0, 4, 6}}) {
            for (const auto& [i, j, k] : {std::array{a, b, c}, {a, c, d}}) {
                all.push_back({corner[std::size_t(i)], corner[std::size_t(inside_out ? k : j)],
                               corner[std::size_t(inside_out ? j : k)]});
            }
        }
        return all;
    }
};

/// Loose triangles, of a part each box.
inline MeshFile mesh_of(const std::vector<Box>& boxes) {
    MeshFile mesh;
    for (const Box& box : boxes) {
        mesh.part.push_back({"box " + std::to_string(mesh.part.size()), ""});
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        for (const auto& corner : box.triangles()) {
            std::array<std::uint32_t, 3> of{};
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t v = first;
                while (v < mesh.vertex.size() && mesh.vertex[v] != corner[k]) ++v;
                if (v == mesh.vertex.size()) mesh.vertex.push_back(corner[k]);
                of[k] = v;
            }
            mesh.triangle.push_back(of);
            mesh.part_of.push_back(static_cast<std::uint16_t>(mesh.part.size() - 1));
        }
    }
    return mesh;
}

}  // namespace read_mesh
