#pragma once

#include <filesystem>
#include <string>

namespace diurna {

/// Advice to whoever names a file that no driver reads: its data if it is the header of a raster,
/// its name if it is an HGT without a place, else the known formats.
std::string unread_hint(const std::filesystem::path& file, const std::string& formats);

/// The header of a raster that a file is the data of, dem.hdr of dem.bil or of dem, or dem.bil.hdr;
/// "" where none is beside it.
std::filesystem::path header_beside(const std::filesystem::path& file);

}  // namespace diurna
