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
    std::vector<std::string> notes;     // what was repaired or skipped
    std::vector<std::string> warnings;  // what may be wrong in the file
};

/// Reads OBJ, PLY, STL and glTF 2 (.obj .ply .stl .gltf .glb), coordinates as doubles. Polygons are
/// cut into triangles (cut_polygon.hpp), nodes placed as the file says, triangles of nodes that
/// mirror them turned, vertices welded (weld_vertices.hpp).
///
/// Throws InputError if the file is of another kind, cannot be read, is not what it says, holds no
/// triangle, a vertex that is not finite, more than 5 million triangles, or names a buffer beyond
/// the confines. Libraries of materials that an OBJ names are not opened.
///
/// - confines: of the buffers that it names; without, its folder's
MeshFile read_mesh_file(const std::filesystem::path& file,
                        const std::optional<Confines>& confines = {});

}  // namespace diurna
