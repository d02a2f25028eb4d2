#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/raster/geotransform.hpp"
#include "terrain/raster/lattice_map.hpp"

namespace diurna {

inline constexpr double most_posts = 5e8;  // of a raster

struct DemDetail;

/// An elevation raster: heights at posts (pixel centres), row 0 in the north (a file stored south
/// first is flipped), so that columns and rows turn clockwise seen from above. Heights are in
/// metres above the geoid or ellipsoid as in the file, unless `geoid` requests the ellipsoid;
/// within a scene the difference is nearly constant.
struct Dem {
    std::string source;  // file it came from
    int columns = 0, rows = 0;
    std::vector<float> height;  // (row, column) [m]; NaN where void
    GeoTransform transform{};
    std::string crs_wkt;  // or a name such as EPSG:32611

    float at(int row, int column) const { return height[std::size_t(row) * columns + column]; }
    std::size_t voids = 0;              // posts without elevation in the file
    std::vector<std::uint8_t> is_void;  // (row, column) 1 at voids; empty without voids
    std::vector<std::string> notes;     // for the report: uncertain datum, seams
    std::vector<Mistake> warnings;      // implausible values: heights of an unknown unit
    std::vector<DemDetail> detail;  // finer rasters on it, later ones on top (ground/dem_detail)
};

/// A finer raster on a coarse one, of any CRS and lattice. At its border its heights equal the
/// coarse raster's interpolated ones, so that the two form one surface.
struct DemDetail {
    Dem raster;            // extends over the coarse raster's edge by two posts at most
    LatticeMap to_own;     // (column, row) of the coarse raster to its own
    LatticeMap to_coarse;  // and back
    /// Outline of its part of the coarse raster, in (column, row) of that: its border's posts, and
    /// points with the same spacing along the coarse raster's edge.
    std::vector<Eigen::Vector2d> outline;
    double tolerance = 1.0;  // of a mesh of it [m]
};

/// Index of the detail at a fractional (column, row) of the coarse raster, the last of several; −1:
/// none.
int detail_at(const Dem& dem, const Eigen::Vector2d& place);

/// Whether any post has no height now; `Dem::voids` is the number missing in the file.
bool has_voids(const Dem& dem);

/// Height [m] at a fractional (column, row), bilinear between posts, or between a detail's posts if
/// it is on one; NaN outside or next to a void. In a cell with one void corner: the plane through
/// the three others, on their half.
double height_at(const Dem& dem, const Eigen::Vector2d& place);

/// Height [m] of the valid post nearest to a post.
double nearest_height(const Dem& dem, int row, int column);

}  // namespace diurna
