#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "materials/base/files_read.hpp"

namespace diurna {

/// Opens a regular file of at most `limit` bytes, to be read in parts. Throws as read_text().
std::ifstream open_file(const std::filesystem::path& path, std::uintmax_t limit);

/// The text of a regular file of at most `limit` bytes. Throws InputError naming the file if it is
/// missing, not a regular file, unreadable or larger.
std::string read_text(const std::filesystem::path& path, std::size_t limit = 64u << 20);

/// Writes a whole file or none: into a temporary file beside it, flushed to disk, then renamed.
/// Throws std::runtime_error with path and reason; the target is then unchanged.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// Throws InputError if results cannot be written to a path: it is a device, a pipe, a folder or
/// one of the `inputs` of the results; or its folder does not exist or takes no new file. Leaves
/// nothing there.
void check_output_file(const std::filesystem::path& path, const std::vector<FileRead>& inputs = {});

/// Why results cannot be written into a folder, which need not exist: it or one above is not a
/// folder, or takes no new file; "" if they can. Leaves nothing there.
std::string why_no_output_folder(const std::filesystem::path& folder);

}  // namespace diurna
