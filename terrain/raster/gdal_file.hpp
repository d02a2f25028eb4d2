#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <string>

#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

/// Opens a file with the drivers named (null at the end), never one of GDAL's connection strings.
/// `kind` is GDAL_OF_RASTER or GDAL_OF_VECTOR, `formats` the advice to whoever has another one.
/// Throws InputError with GDAL's reason, or of a sidecar beyond the gate.
GDALDatasetUniquePtr open_gdal_file(const std::filesystem::path& file, unsigned kind,
                                    const char* const* drivers, const char* formats,
                                    const QuietGdal& gdal, const GdalGate& gate);

/// Refuses what takes gigabytes to read one band of: over 4096 bands, and blocks of over 512 MB, in
/// which the values of all bands may stand side by side, for GDAL reads blocks whole. Throws
/// InputError.
void check_bands(GDALDataset& data, const std::string& where);

/// Has GDAL look for a dataset's sidecars, which are noted (materials/base/files_read.hpp). Throws
/// InputError of one beyond the gate.
void look_beside(GDALDataset& data, const GdalGate& gate);

/// True of more bytes than a file can hold however well they are compressed: DEFLATE cannot do
/// better than 1032 : 1.
bool claims_too_much(double bytes, const std::filesystem::path& file);

}  // namespace diurna
