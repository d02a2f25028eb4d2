#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// What mends a line that is no TOML, for what people are used to write: paths of Windows, units
/// behind numbers, words without quotes, typographic quotes, a comma as decimal sign, comments of
/// other languages. "" where it looks like none of these.
std::string syntax_hint(std::string_view line);

/// A file's text begins as UTF-16 does.
bool is_utf16(std::string_view text);

/// How to mend a text of UTF-16.
inline constexpr const char* utf16_problem = "is in UTF-16, expected UTF-8";
inline constexpr const char* utf16_hint = "save it as UTF-8 (\"CSV UTF-8\" in spreadsheets)";

}  // namespace diurna
