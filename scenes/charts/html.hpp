#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace diurna {

/// A text for HTML and SVG: <, >, &, " and ' escaped, control characters as '?'.
std::string escaped(const std::string& text);

/// Bytes in base64 (RFC 4648), for pictures within a page.
std::string base64(std::span<const std::byte> bytes);

}  // namespace diurna
