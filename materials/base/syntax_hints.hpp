#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// Remedy for a line that is not TOML, for common habits: Windows paths, units after numbers, words
/// without quotes, typographic quotes, a comma as decimal sign, comments of other languages. "" if
/// it looks like none of these.
std::string syntax_hint(std::string_view line);

/// Whether a file's text begins like UTF-16.
bool is_utf16(std::string_view text);

/// Message for a text in UTF-16.
inline constexpr const char* utf16_problem = "is in UTF-16, expected UTF-8";
inline constexpr const char* utf16_hint = "save it as UTF-8 (\"CSV UTF-8\" in spreadsheets)";

}  // namespace diurna
