#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace diurna {

/// SHA-256 as 64 hexadecimal digits, of a text, of pieces one after the other or of a file's
/// content.
std::string sha256(std::string_view text);
std::string sha256(std::span<const std::string_view> pieces);
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace diurna
