#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/geotransform.hpp"

namespace diurna {

/// A raster of integer classes, of any CRS and resolution. A value belongs to its whole
/// cell.
struct ClassRaster {
    std::string source;
    int columns = 0, rows = 0;
    std::vector<std::int32_t> value;  // (row, column); no_class where the file has nodata
    GeoTransform transform{};
    std::string crs_wkt;
};
inline constexpr std::int32_t no_class = std::numeric_limits<std::int32_t>::min();

/// Reads a class raster (GeoTIFF, ENVI, netCDF, ESRI ASCII). Throws InputError if it is missing,
/// damaged, without georeference or CRS, a picture (red, green, blue), or has fractional values.
///
/// - confines: of its sidecars; default: its folder
ClassRaster read_class_raster(const std::filesystem::path& file,
                              const std::optional<Confines>& confines = {});

/// The class at each place; no_class outside the raster.
std::vector<std::int32_t> classes_at(const ClassRaster& raster, std::span<const Geodetic> places);

}  // namespace diurna
