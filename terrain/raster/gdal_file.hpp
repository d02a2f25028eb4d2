#pragma once

#include <gdal_priv.h>

#include <filesystem>

#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

/// Opens a file with the drivers named (null at the end), never one of GDAL's connection strings.
/// `kind` is GDAL_OF_RASTER or GDAL_OF_VECTOR, `formats` the advice to whoever has another one.
/// Throws InputError with GDAL's reason.
GDALDatasetUniquePtr open_gdal_file(const std::filesystem::path& file, unsigned kind,
                                    const char* const* drivers, const char* formats,
                                    const QuietGdal& gdal);

/// Notes all files that a dataset is read of, its sidecars too (materials/base/files_read.hpp).
void note_files_of(GDALDataset& data);

/// True of more bytes than a file can hold however well they are compressed: DEFLATE cannot do
/// better than 1032 : 1.
bool claims_too_much(double bytes, const std::filesystem::path& file);

}  // namespace diurna
