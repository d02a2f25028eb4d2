#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diurna {

/// Where the files that a scene, a column or a library names may lie, and those that a mesh, a
/// raster or shapes name in turn. Who sends such a file chooses what is read, but not beyond them.
struct Confines {
    std::vector<std::filesystem::path> folders;  // resolved; what is read lies beneath one of them
    bool everywhere = false;                     // --allow-outside: any regular file
};

/// Of a file that the user has named: its folder, itself wherever it leads, and the program's own
/// data (data_folder(), the samples beside it in the sources).
Confines confines_of(const std::filesystem::path& file);

/// The same, or with `allow_outside` every regular file.
Confines confines_of(const std::filesystem::path& file, bool allow_outside);

/// Why a file may not be read, "" where it may: it lies elsewhere once links are followed (whether
/// or not it exists, which nobody is reported), or is a device, a pipe, a folder.
std::string why_not(const Confines& confines, const std::filesystem::path& file);

/// What mends a refusal.
inline constexpr const char* allow_outside_hint = "--allow-outside permits it";

}  // namespace diurna
