#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <string>

#include "terrain/raster/gdal_formats.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

/// Opens a file with the drivers for a use, never one of GDAL's connection strings. Throws
/// InputError with GDAL's reason and the known formats, or for a sidecar beyond the gate.
GDALDatasetUniquePtr open_gdal_file(const std::filesystem::path& file, GdalUse use,
                                    const QuietGdal& gdal, const GdalGate& gate);

/// Refuses files that need gigabytes to read one band: over 4096 bands, and blocks of over 512 MB,
/// which may interleave the values of all bands, because GDAL reads whole blocks. Throws
/// InputError.
void check_bands(GDALDataset& data, const std::string& where);

/// Lets GDAL search for a dataset's sidecars, which are recorded (materials/base/files_read.hpp).
/// Throws InputError for one beyond the gate.
void look_beside(GDALDataset& data, const GdalGate& gate);

/// True if this is more data than a file can hold at the best compression: DEFLATE cannot exceed
/// 1032 : 1.
bool claims_too_much(double bytes, const std::filesystem::path& file);

}  // namespace diurna
