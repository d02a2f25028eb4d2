#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// Whether a name or message has only printable characters: UTF-8 without control characters (line
/// ends and escape sequences among them) and without characters that change the direction of the
/// text that follows.
bool is_plain(std::string_view text);

/// The same text with '?' for each byte that is not plain.
std::string plain(std::string_view text);

}  // namespace diurna
