#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "terrain/place/site.hpp"

namespace diurna {

/// A raster of whole-numbered classes, of any CRS and resolution. A value belongs to its whole
/// cell.
struct ClassRaster {
    std::string source;
    int columns = 0, rows = 0;
    std::vector<std::int32_t> value;  // (row, column); no_class where the file has nodata
    std::array<double, 6> transform{};
    std::string crs_wkt;
};
inline constexpr std::int32_t no_class = std::numeric_limits<std::int32_t>::min();

/// Reads a class raster (GeoTIFF, ENVI, netCDF, ESRI ASCII). Throws InputError for one that is
/// missing, damaged, without georeference or CRS, or of broken numbers.
ClassRaster read_class_raster(const std::filesystem::path& file);

/// The class at each place; no_class outside the raster.
std::vector<std::int32_t> classes_at(const ClassRaster& raster, std::span<const Geodetic> places);

/// A polygon or line of a vector file, by geodetic corners (height 0), not closed.
struct LandShape {
    std::string kind;  // what the class field says; empty without one
    double height = std::numeric_limits<double>::quiet_NaN();  // what the height field says [m]
    bool line = false;
    std::vector<Geodetic> ring;
    std::vector<std::vector<Geodetic>> hole;
};

/// Reads all polygons and lines of a GeoJSON, ESRI Shapefile or GeoPackage; parts of a multi-shape
/// one by one. Throws InputError for a missing or damaged file, one without CRS, a field that no
/// layer has, or more than a million corners.
std::vector<LandShape> read_shapes(const std::filesystem::path& file,
                                   const std::string& kind_field = "",
                                   const std::string& height_field = "");

/// The area within half a width [m] of a line given by east and north, as a ring; bends are mitred,
/// at most to twice the width.
std::vector<Eigen::Vector2d> ribbon(std::span<const Eigen::Vector2d> line, double width);

}  // namespace diurna
