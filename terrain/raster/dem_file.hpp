#pragma once

#include <filesystem>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// Reads one elevation raster: its heights in metres, voids as NaN, row 0 in the north, its place
/// and CRS, and notes of what is doubtful about them. All of it if `whole`, else the window of the
/// options. To read one more format, name its GDAL driver here; to read one that GDAL does not,
/// fill a Dem beside this. Throws InputError as read_dem.hpp says.
Dem read_tile(const std::filesystem::path& file, const DemOptions& options, bool whole);

}  // namespace diurna
