#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/dem.hpp"

namespace diurna {

/// A triangulated irregular network over the posts of a raster.
struct Tin {
    std::vector<std::array<std::int32_t, 2>> post;       // (vertex) column, row
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from above
                                                         // (columns east, rows south)
};

/// Greedy insertion into a Delaunay triangulation (CGAL, exact predicates) until no post of the
/// raster lies further than `tolerance` [m] from the surface, measured vertically. Voids are not
/// inserted nor covered. `keep`: polylines of posts that become vertices. tolerance 0 keeps every
/// post that is not exactly on the surface.
Tin triangulate(const Dem& dem, double tolerance,
                std::span<const std::array<std::int32_t, 2>> keep = {});

/// The same with a tolerance that differs from post to post: `tolerance` times `slack`
/// (row, column), more than 0. One network without cracks; finer where the slack is small.
Tin triangulate(const Dem& dem, double tolerance, std::span<const float> slack);

/// Checks a network by rasterising each triangle anew, independent of how it was made.
struct TinCheck {
    double worst_error = 0.0;         // [m] vertical
    double rms_error = 0.0;           // [m]
    std::size_t uncovered_posts = 0;  // valid posts under no triangle
    std::size_t flipped_triangles = 0;
};
TinCheck check_tin(const Dem& dem, const Tin& tin);

}  // namespace diurna
