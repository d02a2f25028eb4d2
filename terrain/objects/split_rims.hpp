#pragma once

#include <cstddef>

#include "terrain/objects/file_mesh.hpp"
#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

/// Result of splitting, lengths in the file's unit.
struct SplitRims {
    std::size_t vertices = 0;  // near an edge, now corners of its triangle
    double farthest = 0.0;     // largest distance of such a vertex from its edge
    std::size_t closed = 0;    // pieces that it closed
};

/// Joins vertices of open edges to other open edges that pass close to them (T-junctions with a
/// gap): the triangle at such an edge is cut at the vertex. Only if that closes a piece. The
/// vertex is within `tolerance` and a quarter of the shortest edge at it from the edge, between
/// its ends.
///
/// Nothing is done for meshes of over 5000 open edges: these are sheets.
SplitRims split_rims(MeshFile& mesh, const MeshPieces& pieces, double tolerance);

}  // namespace diurna
