#pragma once

#include <gdal_priv.h>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_options.hpp"
#include "terrain/raster/dem_window.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

/// Reads the heights of a window of the first band into `dem.height` [m], NaN where void.
///
/// Voids are those of GDAL's mask band (nodata value, internal mask, alpha band, .msk file), NaN,
/// the undeclared −32768, −32767, 32767 and −9999, and anything below −12 km. The unit is the
/// option's, else the band's (height_unit.hpp), else the vertical CRS's, else metres. Conversions
/// are added to the notes; heights without a unit on a map that is not in metres to the warnings.
/// Throws InputError for an unknown unit, a damaged file, or
/// heights over 10 km.
void read_heights(GDALDataset& raster, const PostWindow& window, const DemOptions& options,
                  Dem& dem, const QuietGdal& gdal);

}  // namespace diurna
