#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "terrain/raster/geotransform.hpp"

namespace diurna {

inline constexpr double most_posts = 5e8;  // of a raster

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
};

/// Whether any post has no height now; `Dem::voids` counts what the file lacked.
bool has_voids(const Dem& dem);

/// Height [m] at a fractional (column, row), bilinear between posts; NaN outside or beside a void.
/// In a cell with one void corner, the plane through the three others on their half.
double height_at(const Dem& dem, const Eigen::Vector2d& place);

/// Height [m] of the valid post nearest to a post.
double nearest_height(const Dem& dem, int row, int column);

}  // namespace diurna
