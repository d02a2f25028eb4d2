#pragma once

#include <cstdint>
#include <vector>

#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// Which triangles belong to a piece that encloses no volume: a sheet, an open box, a tube. Pieces
/// are those of mesh_pieces(), with vertices at the same place merged.
///
/// returns  (triangle) 1 in open pieces
std::vector<std::uint8_t> open_pieces(const ObjectMesh& mesh);

}  // namespace diurna
