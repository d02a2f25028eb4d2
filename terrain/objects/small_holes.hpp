#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/objects/mesh_pieces.hpp"

namespace diurna {

/// Enclosed volume, by the orientation of its patches, and area of a piece.
struct PieceBulk {
    double volume = 0.0, area = 0.0;
    /// Distinguishes a solid from two sheets within `apart` of each other.
    bool thicker_than(double apart) const { return volume > apart * area; }
};

/// (piece)
std::vector<PieceBulk> piece_bulks(std::span<const Eigen::Vector3d> vertex,
                                   std::span<const std::array<std::uint32_t, 3>> triangle,
                                   const MeshPieces& pieces);

/// Pieces with holes so small that they are probably errors: one or two missing triangles (a tenth
/// of the area at most), or a fiftieth of the area.
struct SmallHoles {
    std::size_t pieces = 0;
    double share = 0.0;  // largest share of a piece's area
};
SmallHoles small_holes(std::span<const Eigen::Vector3d> vertex,
                       std::span<const std::array<std::uint32_t, 3>> triangle,
                       const MeshPieces& pieces);

}  // namespace diurna
