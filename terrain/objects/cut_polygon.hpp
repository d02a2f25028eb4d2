#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// A polygon as triangles of its corners.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangle;  // indices of corners, same orientation
    bool sound = true;  // false: it crosses itself, and the triangles cover another area
};

/// Cuts a polygon, convex or not, with corners on straight edges, or with holes that bridges join
/// to its border, by ear clipping, projected along its area vector (Newell). Corners at the same
/// place as the previous one are skipped. The triangles' area vectors add up to the polygon's, and
/// none of them is reversed; if that fails, `sound` is false. A convex quadrilateral is cut along
/// the diagonal from its first corner.
///
/// Time grows with the square of the number of corners.
CutPolygon cut_polygon(std::span<const Eigen::Vector3d> corner);

}  // namespace diurna
