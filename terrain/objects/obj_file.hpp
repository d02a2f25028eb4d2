#pragma once

#include <filesystem>
#include <string>

#include "terrain/objects/mesh_file.hpp"

namespace diurna {

/// Writes a mesh as Wavefront OBJ, whole or not at all: a group for each part, vertices to a
/// hundredth of a millimetre. A mesh with z up and its front towards +y is written with y up and
/// the front towards +z, as users of read_mesh_file expect of OBJ.
///
/// comment  first line
void write_obj(const std::filesystem::path& file, const MeshFile& mesh, const std::string& comment);

}  // namespace diurna
