#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// A polygon as triangles of its corners.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangle;  // numbers of corners, facing as it does
    bool sound = true;  // false: it crosses itself, and the triangles cover another area
};

/// Cuts a polygon, convex or not, with corners on straight edges, or with holes that bridges join
/// to its border, by clipping ears; seen along its area vector (Newell). Corners at the place of
/// the one before are passed over. The triangles' area vectors add up to the polygon's, and none
/// of them is turned over; where that fails, `sound` is false. Of a convex quadrilateral the
/// diagonal from its first corner.
///
/// Takes the square of the number of corners.
CutPolygon cut_polygon(std::span<const Eigen::Vector3d> corner);

}  // namespace diurna
