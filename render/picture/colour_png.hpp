#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// A picture with transparency as PNG in memory.
///
/// - pixels: (row, column, red green blue opacity), 8 bits each, sRGB, the first row on top
///
/// Throws std::runtime_error if it cannot be encoded.
std::vector<std::byte> encode_rgba_png(int width, int height, std::span<const std::uint8_t> pixels);

}  // namespace diurna
