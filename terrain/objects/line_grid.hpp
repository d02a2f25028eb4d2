#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// Triangles in the columns of a square grid, to count the crossings of lines in one direction.
class LineGrid {
 public:
    /// - which: the triangles that count
    /// - direction: of the line, unit; not along an axis, so that no line runs along an edge
    LineGrid(std::span<const Eigen::Vector3d> vertex,
             std::span<const std::array<std::uint32_t, 3>> triangle,
             std::span<const std::uint32_t> which, const Eigen::Vector3d& direction);

    struct Crossed {
        int ahead = 0, behind = 0;
    };
    /// Triangles that the line through a point crosses, except `skipped`.
    Crossed crossed(const Eigen::Vector3d& point, std::uint32_t skipped = std::uint32_t(-1)) const;

 private:
    struct Flat {
        std::array<Eigen::Vector3d, 3> corner;  // across, across, along the line
        std::uint32_t triangle;
    };
    std::size_t cell(double across, int axis) const;

    Eigen::Matrix3d turn_;  // to (across, across, along)
    Eigen::Vector3d origin_;
    Eigen::Vector2d low_, step_;
    std::size_t side_ = 1;                // cells along each axis
    std::vector<std::uint32_t> first_;    // (cell + 1)
    std::vector<std::uint32_t> in_cell_;  // numbers of flat_
    std::vector<Flat> flat_;
};

}  // namespace diurna
