#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace diurna {

/// A glyph of 5 × 7 pixels: rows from the top, the leftmost pixel in bit 4. Descenders take up
/// two more rows below.
using Glyph = std::array<std::uint8_t, 9>;
inline constexpr int glyph_width = 5, glyph_height = 9, glyph_advance = 6;

/// The glyphs of a UTF-8 text: ASCII, '°' and 'µ'; a box for everything else.
std::vector<Glyph> glyphs_of(std::string_view text);

}  // namespace diurna
