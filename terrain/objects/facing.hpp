#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Result of orienting the closed pieces of a mesh.
struct Facing {
    std::size_t closed = 0;     // pieces that enclose something
    std::size_t turned = 0;     // of them: faced inwards, turned outwards (cavities: the reverse)
    std::size_t cavities = 0;   // of them: faces of a hollow within another piece
    std::size_t triangles = 0;  // of other pieces: turned to agree with their neighbours
};

/// Turns the triangles of each closed piece so that all of them face away from its solid: the
/// enclosed volume is positive. Open pieces are unchanged.
///
/// A piece within another one is a cavity of it, and faces inwards, if both have the same material;
/// else it keeps its orientation relative to the enclosing piece (a body in a box of glass). Pieces
/// that touch along edges of three or more triangles and share walls face the side that lines from
/// outside can reach.
///
/// - material: (part) the name of its material
Facing turn_outward(MeshFile& mesh, std::span<const std::string> material);

/// A note for the report; "" if nothing was turned.
std::string facing_note(const Facing& facing);

}  // namespace diurna
