#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"

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
/// that is not finite, more than 5 million triangles, or a name of a file beyond the confines.
///
/// - confines: of what it names, such as buffers and libraries of materials; without, its folder's
MeshFile read_mesh_file(const std::filesystem::path& file,
                        const std::optional<Confines>& confines = {});

}  // namespace diurna
