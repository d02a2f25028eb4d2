#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Whether a file is a zip archive, by its first bytes; false where it cannot be read.
bool is_zip(const std::filesystem::path& file);

/// The files in an archive, "folder/name.hgt", in its order. Throws InputError for a damaged one or
/// more than 10 000.
std::vector<std::string> zip_members(const std::filesystem::path& file);

/// One of them, unpacked. Throws InputError for one of more than `limit` bytes or a damaged one.
std::vector<std::byte> zip_member(const std::filesystem::path& file, const std::string& member,
                                  std::size_t limit);

/// GDAL's name of a raster: the file itself, the one raster in a zip archive (of SRTM and others:
/// .hgt, .tif, .dt0 to .dt2, .asc, .dem, .bil, .flt, .img, pictures, or what has a .hdr beside it),
/// or what a .gz holds. What macOS puts into an archive beside its files (__MACOSX) counts for
/// nothing. Absolute, so that no name is taken for one of GDAL's connection strings. Throws
/// InputError for an archive of no raster or several.
std::string gdal_raster_name(const std::filesystem::path& file);

/// The same of shapes: .shp, .gpkg, .geojson, .json, .geojsonl, .kml or .fgb in a zip archive, of
/// which KMZ is one, or in a .gz.
std::string gdal_vector_name(const std::filesystem::path& file);
/// Whether a file is an archive of such shapes and of no raster.
bool holds_shapes(const std::filesystem::path& file);

/// The text of a file as its reader has it, unpacked from a zip archive or a .gz. Throws InputError
/// of one over 4 GB.
std::string unpacked_text(const std::filesystem::path& file);

}  // namespace diurna
