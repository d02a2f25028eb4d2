#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// A mesh as its file gives it: one part per node and material of the file.
struct MeshFile {
    struct Part {
        std::string node;      // or group (OBJ); may be empty
        std::string material;  // as named in the file; may be empty
    };
    std::vector<Eigen::Vector3d> vertex;  // the file's own axes and unit
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::vector<std::uint16_t> part_of;  // (triangle)
    std::vector<Part> part;
};

/// Reads OBJ, PLY, STL and glTF 2 (.obj .ply .stl .gltf .glb); polygons are cut into triangles,
/// equal corners become one vertex, and nodes are placed as the file says.
///
/// Throws InputError if the file is of another kind, cannot be read, holds no triangle, a vertex
/// that is not finite, or more than 5 million triangles.
MeshFile read_mesh_file(const std::filesystem::path& file);

/// Which way is up in a file; its front looks along +z where y is up (glTF), along +y where z is.
enum class UpAxis { y, z };

/// How a mesh stands in the scene.
struct Placing {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();  // its middle in plan and its lowest point [m]
    double heading_deg = 0.0;                        // the way its front looks, from north
    UpAxis up = UpAxis::y;
    double metres = 1.0;        // per unit of the file
    double largest_edge = 0.5;  // longer edges are cut [m]
};

/// The mesh turned, scaled and put down, its long edges halved until none is longer than
/// `largest_edge`: neighbours share the new vertices, so that no crack opens. A closed mesh that is
/// inside out is turned outside.
///
/// material  (part of the file)
ObjectMesh placed_mesh(const MeshFile& mesh, const Placing& placing,
                       const std::vector<MaterialId>& material);

}  // namespace diurna
