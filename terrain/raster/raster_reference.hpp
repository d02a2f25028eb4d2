#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <optional>

namespace diurna {

/// The coordinate reference system of an open raster; nullopt if it has none:
///
/// - the one in the file;
/// - netCDF without a grid_mapping, whose axes are latitude and longitude by the CF conventions
///   (units degrees_north and degrees_east, standard_name, or their usual names): WGS84, which
///   files of ERA5, ETOPO and NOAA use;
/// - a gzipped ESRI ASCII grid, dem.asc.gz: the one in dem.prj beside it.
///
/// Throws InputError for netCDF whose values are in the order longitude, latitude.
std::optional<OGRSpatialReference> raster_reference(GDALDataset& raster,
                                                    const std::filesystem::path& file);

}  // namespace diurna
