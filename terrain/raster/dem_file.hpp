#pragma once

#include <filesystem>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"

namespace diurna {

/// Reads one elevation raster: its heights in metres, voids as NaN, row 0 in the north, its
/// position and CRS, and notes of uncertainties. All of it if `whole`, else the window of the
/// options. To support another format of GDAL, add its driver here; for a format that GDAL does not
/// read, fill a Dem in a new file. Throws InputError as read_dem.hpp.
Dem read_tile(const std::filesystem::path& file, const DemOptions& options, bool whole);

}  // namespace diurna
