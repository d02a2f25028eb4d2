#pragma once

#include <cstddef>
#include <string>

#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// Result of welding a mesh's vertices, lengths in the file's unit.
struct WeldedVertices {
    std::size_t joined = 0;       // vertices merged into another one
    double farthest = 0.0;        // largest distance between two merged vertices
    std::size_t collapsed = 0;    // triangles that lost their area
    std::size_t closed = 0;       // pieces of the mesh that became closed
    std::size_t split = 0;        // vertices near an edge, moved onto it
    double farthest_split = 0.0;  // largest distance of these from the edge
    // Pieces that are still open but nearly closed.
    std::size_t nearly_closed = 0;
    double gap = 0.0;           // largest distance that would have to be joined to close them
    std::size_t gap_edges = 0;  // their open edges
    double hole_share = 0.0;    // of the others: the largest share of a piece's area in holes
};

/// Merges vertices within 1e-6 of the mesh's diagonal; then, only along open edges, those
/// within 1e-5 or 1e-4 if that closes a piece or continues a sheet, and within 1e-3 if it
/// closes a piece. Never merges two that are farther apart than a quarter of the shortest edge
/// at either, not counting edges up to 1e-6 of the diagonal (ends of needles). If a piece
/// stays open: determines whether 1e-2 would close it, or whether its holes are small.
/// Vertices within 1e-3 of open edges are joined to these if that closes a piece
/// (split_rims.hpp).
WeldedVertices weld_vertices(MeshFile& mesh);

/// Notes for the report; "" if nothing was done.
std::string welded_note(const WeldedVertices& welded);
std::string nearly_closed_warning(const WeldedVertices& welded);

}  // namespace diurna
