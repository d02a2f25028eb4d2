#pragma once

#include <cstddef>
#include <string>

#include "terrain/objects/file_mesh.hpp"

namespace diurna {

/// What welding a mesh's vertices did, lengths in the file's unit.
struct WeldedVertices {
    std::size_t joined = 0;       // vertices that became one with another
    double farthest = 0.0;        // of them, the largest distance between two that became one
    std::size_t collapsed = 0;    // triangles that lost their area by it
    std::size_t closed = 0;       // pieces of the mesh that it closed
    std::size_t split = 0;        // vertices that lay beside an edge and are on it now
    double farthest_split = 0.0;  // of them from the edge
    // Pieces that are still open, though hardly.
    std::size_t nearly_closed = 0;
    double gap = 0.0;           // of those that would be closed by joining what lies further apart
    std::size_t gap_edges = 0;  // their open edges
    double hole_share = 0.0;    // of the others: the largest share of a piece's area in holes
};

/// Makes one vertex of those that lie within 1e-6 of the mesh's diagonal; then, along open edges
/// alone, of those within 1e-5 or 1e-4 if that closes a piece or continues a sheet, and within 1e-3
/// if it closes a piece. Never of two that are further apart than a quarter of the shortest edge at
/// either, edges up to 1e-6 of the diagonal between the ends of a needle apart. Where a piece stays
/// open: finds whether the same within 1e-2 would close it, or whether its holes are small.
/// Vertices within 1e-3 of open edges are joined to these where that closes a piece
/// (split_rims.hpp).
WeldedVertices weld_vertices(MeshFile& mesh);

/// Lines for the reader of a report; "": nothing to say.
std::string welded_note(const WeldedVertices& welded);
std::string nearly_closed_warning(const WeldedVertices& welded);

}  // namespace diurna
