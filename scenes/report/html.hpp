#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace diurna {

/// A text as HTML and SVG show it: <, >, &, " and ' spelt out, what steers a reader as '?'.
std::string escaped(const std::string& text);

/// Bytes in the 64 digits of RFC 4648, for pictures within a page.
std::string base64(std::span<const std::byte> bytes);

}  // namespace diurna
