#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"

namespace diurna {

/// An elevation raster: heights at posts (pixel centres), row 0 in the north (a file stored south
/// first is turned over), so that columns and rows turn clockwise seen from above. Heights are in
/// metres above the geoid or ellipsoid as the file has them, unless `geoid` asks for the ellipsoid;
/// within a scene the difference is nearly a constant.
struct Dem {
    std::string source;  // file it came from
    int columns = 0, rows = 0;
    std::vector<float> height;          // (row, column) [m]; NaN where void
    std::array<double, 6> transform{};  // GDAL's affine transform, pixel corner convention
    std::string crs_wkt;                // or a name such as EPSG:32611

    float at(int row, int column) const { return height[std::size_t(row) * columns + column]; }
    std::size_t voids = 0;              // posts without elevation in the file
    std::vector<std::uint8_t> is_void;  // (row, column) 1 there; empty where there is none
    std::vector<std::string> notes;     // what a reader should know: doubtful datum, seams
};

/// What becomes of voids: the file is refused, they stay as holes in the mesh, or they are filled
/// smoothly from the posts around (averages of coarser and coarser grids, the finest that knows).
enum class VoidPolicy { refuse, leave, fill };

struct DemOptions {
    VoidPolicy voids = VoidPolicy::refuse;
    /// Keep only the window of posts that holds the circle of this radius [m] round a place; none:
    /// the whole raster.
    std::optional<Geodetic> centre = std::nullopt;
    double radius = 0.0;
    /// Metres per unit of the file's heights; none: as the file says, metres if it says nothing.
    std::optional<double> unit = std::nullopt;
    /// Adds EGM96's geoid, so that heights above the sea become heights above the ellipsoid.
    bool geoid = false;
};

/// Reads any elevation raster of the allow-listed GDAL drivers (GeoTIFF, DTED, SRTM HGT also
/// zipped, USGS DEM, ESRI ASCII, ENVI, netCDF). Sizes are checked against the file before memory is
/// taken. Voids are declared ones and the undeclared −32768, −32767, 32767, −9999, NaN and anything
/// below −12 km. Throws InputError in one clear line for a file that is missing, not a raster, has
/// no valid post, less than 2 × 2 posts, no or a singular georeference, no CRS, or heights that are
/// not metres.
Dem read_dem(const std::filesystem::path& file, const DemOptions& options = {});

/// Several tiles as one raster, posts of shared seams once. All lie on one lattice of one CRS; a
/// post takes the first tile that knows it, and tiles that disagree by more than a metre on the
/// posts they share are told in the notes. Posts that no tile has are voids. Tiles either side of
/// the date line join.
Dem read_dem(std::span<const std::filesystem::path> tiles, const DemOptions& options = {});

/// EGM96's geoid above the WGS84 ellipsoid [m], bilinear on its 15′ grid (PROJ's egm96_15).
/// Throws InputError if PROJ has not got the grid.
std::vector<double> geoid_heights(std::span<const Geodetic> places);

/// Geodetic places of fractional posts (column, row) with their heights, by PROJ through the
/// raster's CRS.
std::vector<Geodetic> geodetic_places(const Dem& dem, std::span<const Eigen::Vector2d> place,
                                      std::span<const float> height);
/// The same for every post, (row, column).
std::vector<Geodetic> post_places(const Dem& dem);
/// Places in the raster as east, north, up [m] in the frame of the site, curvature included.
std::vector<Eigen::Vector3d> local_vertices(const Dem& dem, const Site& site,
                                            std::span<const Eigen::Vector2d> place,
                                            std::span<const float> height);

/// Fractional (column, row) of geodetic places (their heights do not matter), or of points of the
/// ground given by east and north [m] in the frame of the site. Places outside the raster give
/// numbers outside [0, columns − 1] × [0, rows − 1].
std::vector<Eigen::Vector2d> raster_places(const Dem& dem, std::span<const Geodetic> places);
std::vector<Eigen::Vector2d> raster_places(const Dem& dem, const Site& site,
                                           std::span<const Eigen::Vector2d> east_north);

/// Distance [m] between neighbouring columns and between neighbouring rows, mid-raster.
Eigen::Vector2d post_spacing(const Dem& dem);
/// The place in the middle of the raster, at the height of the nearest valid post.
Geodetic dem_centre(const Dem& dem);
/// Height [m], bilinear between posts; NaN outside or beside a void.
double height_at(const Dem& dem, const Eigen::Vector2d& place);
double height_at(const Dem& dem, double latitude_deg, double longitude_deg);

}  // namespace diurna
