#pragma once

#include <filesystem>
#include <span>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// Reads any elevation raster of the supported GDAL drivers (GeoTIFF, DTED, SRTM HGT also zipped,
/// USGS DEM, ESRI ASCII, ENVI, netCDF). Sizes are checked against the file before memory is
/// allocated. Voids are declared ones and the undeclared −32768, −32767, 32767, −9999, NaN and
/// anything below −12 km. Throws InputError in one clear line for a file that is missing, not a
/// raster, has no valid post, less than 2 × 2 posts, no or a singular georeference, no CRS, or
/// heights that are not metres.
Dem read_dem(const std::filesystem::path& file, const DemOptions& options = {});

/// Several tiles as one raster. All must be on one lattice of one CRS; at shared seams the first
/// tile with a value is used, and differences of more than a metre between tiles at shared posts
/// are reported in the notes. Posts that no tile has are voids. Tiles on both sides of the date
/// line are joined.
Dem read_dem(std::span<const std::filesystem::path> tiles, const DemOptions& options = {});

}  // namespace diurna
