#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// An edge of one triangle.
struct EdgeSide {
    std::uint32_t low, high;  // its vertices, low < high
    std::uint32_t triangle;
    bool turned;  // the triangle traverses it from high to low
};

/// The sides of all triangles, by edge, then by triangle; an edge between equal vertices has
/// none.
std::vector<EdgeSide> edge_sides(std::span<const std::array<std::uint32_t, 3>> triangle);

/// Calls body(sides of an edge) for each edge.
template <class Body>
void each_edge(std::span<const EdgeSide> sides, const Body& body) {
    for (std::size_t first = 0, last; first < sides.size(); first = last) {
        for (last = first + 1; last < sides.size() && sides[last].low == sides[first].low &&
                               sides[last].high == sides[first].high;) {
            ++last;
        }
        body(sides.subspan(first, last - first));
    }
}

/// Two triangles with a common edge of only these two, or parts of edges on one line.
struct EdgeJoint {
    std::uint32_t a, b;
    bool agree;  // same orientation: they traverse the edge in opposite directions
};

/// Triangles connected by edges.
struct MeshPieces {
    std::vector<std::uint32_t> of;     // (triangle) its piece
    std::vector<std::uint8_t> closed;  // (piece) 1: it encloses a volume
    std::vector<EdgeJoint> joints;     // pairs of triangles whose orientation can be compared
    std::vector<EdgeSide> rims;        // edges of one triangle, without others along them
    std::vector<EdgeSide> rows;        // edges of one triangle, with others along them
    std::size_t size() const { return closed.size(); }
};

/// The pieces of a mesh. A piece is closed if each of its edges has two triangles or more, or other
/// open edges of it run along it end to end (a row of small triangles beside one long edge, to 1e-4
/// of its length). With more than 4000 open edges such rows are not searched.
MeshPieces mesh_pieces(std::span<const Eigen::Vector3d> vertex,
                       std::span<const std::array<std::uint32_t, 3>> triangle);

/// Triangles that can be compared over joints, and which of them have the other orientation.
struct MeshPatches {
    std::vector<std::uint32_t> of;     // (triangle) its patch
    std::vector<std::uint8_t> turned;  // (triangle) 1: opposite to its patch's first
    std::vector<std::uint8_t> sound;   // (patch) 0: it has only one side (a Möbius strip)
};
MeshPatches mesh_patches(std::size_t triangles, std::span<const EdgeJoint> joints);

}  // namespace diurna
