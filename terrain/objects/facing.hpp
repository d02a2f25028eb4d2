#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// What was found of the way in which the closed pieces of a mesh face.
struct Facing {
    std::size_t closed = 0;     // pieces that enclose something
    std::size_t turned = 0;     // of them: faced inwards, now outwards (cavities: the reverse)
    std::size_t cavities = 0;   // of them: faces of a hollow within another piece
    std::size_t triangles = 0;  // of other pieces: faced otherwise than their neighbours, turned
};

/// Turns the triangles of each closed piece so that all of them face away from its matter: the
/// volume that they enclose is positive. Open pieces stay as they are.
///
/// A piece within another one encloses a cavity of it, and faces inwards, if both are of one and
/// the same material; else it keeps its sense relative to the piece that encloses it (a body in a
/// box of glass). Pieces that touch along edges of three or more triangles and share walls face
/// the side from which lines reach the outside.
///
/// - material: (part) the name of its material
Facing turn_outward(MeshFile& mesh, std::span<const std::string> material);

/// A line for the reader of a report; "": nothing was turned.
std::string facing_note(const Facing& facing);

}  // namespace diurna
