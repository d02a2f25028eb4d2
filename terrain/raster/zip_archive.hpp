#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Whether a file is a zip archive, by its first bytes; false if it cannot be read.
bool is_zip(const std::filesystem::path& file);

/// The files in an archive, "folder/name.hgt", in its order. Throws InputError for a damaged one or
/// more than 10 000.
std::vector<std::string> zip_members(const std::filesystem::path& file);

/// One of the files, unpacked. Throws InputError if it exceeds `limit` bytes or is damaged.
std::vector<std::byte> zip_member(const std::filesystem::path& file, const std::string& member,
                                  std::size_t limit);

/// GDAL's name of a raster: the file itself, the one raster in a zip archive (of SRTM and others:
/// .hgt, .tif, .dt0 to .dt2, .asc, .dem, .bil, .flt, .img, pictures, or a file with a .hdr beside
/// it), or the content of a .gz. Files that macOS adds to archives (__MACOSX) are ignored. The name
/// is absolute, so that it is never read as one of GDAL's connection strings. Throws InputError for
/// an archive with no raster or several.
std::string gdal_raster_name(const std::filesystem::path& file);

/// The same for shapes: .shp, .gpkg, .geojson, .json, .geojsonl, .kml or .fgb in a zip archive (KMZ
/// is one), or in a .gz.
std::string gdal_vector_name(const std::filesystem::path& file);
/// Whether a file is an archive with such shapes and without a raster.
bool holds_shapes(const std::filesystem::path& file);

/// The text of a file, unpacked if it is a zip archive or a .gz. Throws InputError if it exceeds 4
/// GB.
std::string unpacked_text(const std::filesystem::path& file);

}  // namespace diurna
