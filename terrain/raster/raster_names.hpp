#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// Remedy for a file that no driver reads: its data file if it is the header of a raster, its name
/// if it is an HGT without a position, else the supported formats.
std::string unread_hint(const std::filesystem::path& file, const std::string& formats);

/// The header that belongs to a raster's data file: dem.hdr for dem.bil or dem, or dem.bil.hdr; ""
/// if there is none beside it.
std::filesystem::path header_beside(const std::filesystem::path& file);

}  // namespace diurna
