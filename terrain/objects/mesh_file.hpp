#pragma once

#include <filesystem>
#include <optional>

#include "materials/base/confines.hpp"
#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Reads OBJ, PLY, STL and glTF 2 (.obj .ply .stl .gltf .glb), coordinates as doubles. Polygons are
/// cut into triangles (cut_polygon.hpp), nodes placed as in the file, triangles of mirroring nodes
/// reversed, vertices welded (weld_vertices.hpp).
///
/// Throws InputError if the file has another format, cannot be read, is inconsistent, holds no
/// triangle, a vertex that is not finite, more than 5 million triangles, or names a buffer outside
/// the confines. Material libraries that an OBJ names are not opened.
///
/// - confines: of the buffers that it names; default: its folder
MeshFile read_mesh_file(const std::filesystem::path& file,
                        const std::optional<Confines>& confines = {});

}  // namespace diurna
