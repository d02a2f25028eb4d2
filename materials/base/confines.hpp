#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Folders that may hold the files named by a scene, a column or a library, and the files that a
/// mesh, a raster or shapes name in turn. No file read may be outside them.
struct Confines {
    std::vector<std::filesystem::path> folders;  // resolved; files must be inside one of them
    bool everywhere = false;                     // --allow-outside: any regular file
};

/// Of a file that the user has named: its folder, the file itself (links are followed), and the
/// program's own data (data_folder(), and the samples beside it in the sources).
Confines confines_of(const std::filesystem::path& file);

/// The same, or with `allow_outside` every regular file.
Confines confines_of(const std::filesystem::path& file, bool allow_outside);

/// Why a file may not be read, "" if it may: it is outside once links are followed (the message
/// does not reveal whether it exists), or it is a device, a pipe or a folder.
std::string why_not(const Confines& confines, const std::filesystem::path& file);

/// Remedy for a refusal.
inline constexpr const char* allow_outside_hint = "--allow-outside permits it";

}  // namespace diurna
