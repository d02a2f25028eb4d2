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
/// first is turned over), so that columns and rows turn clockwise seen from above. Heights are in
/// metres above the geoid or ellipsoid as the file has them, unless `geoid` asks for the ellipsoid;
/// within a scene the difference is nearly a constant.
struct Dem {
    std::string source;  // file it came from
    int columns = 0, rows = 0;
    std::vector<float> height;  // (row, column) [m]; NaN where void
    GeoTransform transform{};
    std::string crs_wkt;  // or a name such as EPSG:32611

    float at(int row, int column) const { return height[std::size_t(row) * columns + column]; }
    std::size_t voids = 0;              // posts without elevation in the file
    std::vector<std::uint8_t> is_void;  // (row, column) 1 there; empty where there is none
    std::vector<std::string> notes;     // what a reader should know: doubtful datum, seams
    std::vector<Mistake> warnings;      // what is implausible: heights of a unit that is not known
    std::vector<DemDetail> detail;  // finer rasters on it, later ones on top (ground/dem_detail)
};

/// A finer raster that lies on a coarse one, of any CRS and lattice. At its border its heights are
/// those of the coarse raster between its posts, so that the two are one surface.
struct DemDetail {
    Dem raster;            // reaches over the coarse raster's edge by two posts at most
    LatticeMap to_own;     // (column, row) of the coarse raster to its own
    LatticeMap to_coarse;  // and back
    /// Round what it has of the coarse raster, in (column, row) of that: its border's posts, and
    /// points as near to each other along the coarse raster's edge.
    std::vector<Eigen::Vector2d> outline;
    double tolerance = 1.0;  // of a mesh of it [m]
};

/// The detail that a fractional (column, row) of the coarse raster lies on, the last of several;
/// −1: none.
int detail_at(const Dem& dem, const Eigen::Vector2d& place);

/// Whether any post has no height now; `Dem::voids` counts what the file lacked.
bool has_voids(const Dem& dem);

/// Height [m] at a fractional (column, row), bilinear between posts, those of a detail where one
/// lies there; NaN outside or beside a void. In a cell with one void corner, the plane through the
/// three others on their half.
double height_at(const Dem& dem, const Eigen::Vector2d& place);

/// Height [m] of the valid post nearest to a post.
double nearest_height(const Dem& dem, int row, int column);

}  // namespace diurna
