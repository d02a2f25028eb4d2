#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// Names and messages that hold nothing but characters to be read: UTF-8 without control characters
/// (lines' ends and escape sequences among them) and without those that turn the direction of what
/// follows.
bool is_plain(std::string_view text);

/// The same text with '?' for each byte that makes it otherwise.
std::string plain(std::string_view text);

}  // namespace diurna
