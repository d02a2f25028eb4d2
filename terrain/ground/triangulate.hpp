#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrain/raster/dem.hpp"

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

/// The same as the first; none as soon as the network and its queue need more memory than so much.
std::optional<Tin> triangulate_within(const Dem& dem, double tolerance, double most_bytes);

/// The network within the tolerance in no more memory than ten times the input and 200 MB for the
/// whole program, the input counted as two bytes a post. Where the greedy network with its queue
/// needs more (about 220 bytes a post of it), the full grid, which is exact and needs 65. Throws
/// InputError where that is too much too.
Tin affordable_network(const Dem& dem, double tolerance);

/// Every post, and two triangles a cell cut from its first to its last corner, as the march over
/// the grid has it (height_field.hpp). A cell with one void corner has one triangle, with more
/// none.
Tin full_grid(const Dem& dem);

/// Checks a network by rasterising each triangle anew, independent of how it was made.
struct TinCheck {
    double worst_error = 0.0;         // [m] vertical
    double rms_error = 0.0;           // [m]
    std::size_t uncovered_posts = 0;  // valid posts under no triangle
    std::size_t flipped_triangles = 0;
};
TinCheck check_tin(const Dem& dem, const Tin& tin);

}  // namespace diurna
