#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace diurna {

/// Corners of a polygon in plan, not closed: fractional (column, row) of a raster, or east and
/// north.
using Ring = std::vector<Eigen::Vector2d>;

/// Twice the area of a triangle, positive if it turns from x to y: left in (east, north), right in
/// (column, row).
template <class Point>
auto turn(const Point& a, const Point& b, const Point& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
}

/// The smallest axis-aligned rectangle around a ring.
struct RingExtent {
    Eigen::Vector2d low, high;
    explicit RingExtent(const Ring& ring);
    bool contains(const Eigen::Vector2d& p) const;
};

/// True for points inside, by the even-odd rule.
bool contains(const Ring& ring, const Eigen::Vector2d& p);

/// The part of a ring on a raster of this size; less than three corners if there is none.
Ring clipped(Ring ring, int columns, int rows);

/// Points along the ring at most `largest_edge` [m] apart, where `spacing` is the distance of
/// columns and of rows [m]. The ring passes through posts that are nearer to it than 0.005 posts, a
/// fifth of `largest_edge` and a fiftieth of its own width, so that no sliver arises between them.
/// Returns less than three points only for a ring without width.
Ring divided(const Ring& ring, double largest_edge, const Eigen::Vector2d& spacing);

/// A lattice aligned with the longest side of a ring of the given corners, inside its divided
/// border at a distance from it, for triangles with edges of about `largest_edge` [m].
Ring lattice_inside(const Ring& corners, const Ring& border, double largest_edge,
                    const Eigen::Vector2d& spacing);

/// Counterclockwise in (east, north), without corners that repeat the previous one (0.1 mm).
Ring counterclockwise(const Ring& ring);

/// A counterclockwise ring with sides moved outward by a distance [m]; corners are mitred, at most
/// to twice the distance. It may cross itself around narrow bays.
Ring widened(const Ring& ring, double distance);

/// The area within half a width [m] of a line given by east and north, as a ring; bends are mitred,
/// at most to twice the width.
Ring ribbon(std::span<const Eigen::Vector2d> line, double width);

}  // namespace diurna
