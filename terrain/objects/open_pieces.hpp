#pragma once

#include <cstdint>
#include <vector>

#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// Which triangles belong to a piece that encloses nothing: a sheet, an open box, a tube. A piece
/// is what hangs together by edges, vertices at the same place counting as one; it is closed if
/// each of its edges has two triangles, or others of its open edges run along it end to end (a row
/// of small triangles beside one long edge).
///
/// returns  (triangle) 1 in open pieces
std::vector<std::uint8_t> open_pieces(const ObjectMesh& mesh);

}  // namespace diurna
