#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"

namespace diurna {

/// What the counts of a grey picture stand for: value = zero + step × count.
struct GreyScale {
    double zero = 0.0, step = 1.0;  // in the plane's unit
};

/// The scale of a plane in a picture of 8 or 16 bits.
///
/// - 16 bits: 0.01 K from 0 K for temperatures, as radiometric cameras write them; from 0 in steps
///   of 1, 2 or 5 times a power of ten for other quantities, the finest that holds the greatest
/// - 8 bits: the ends of the quick-look's colours (colour_scale.hpp), so that a frame's contrast
///   survives
GreyScale grey_scale(const Frame& frame, const std::string& plane, int bits);

/// The counts that a viewer takes for black and white: of 8 bits all of them, of 16 those of the
/// ends of the quick-look's colours. In 16 bits of 0.01 K a scene covers a few thousand of 65536
/// counts, and a viewer that keeps the upper 8 bits shows it in 2 to 10 levels.
struct DisplayCounts {
    int black = 0, white = 255;  // white is above black
};
DisplayCounts display_counts(const Frame& frame, const std::string& plane, int bits);

/// A plane in counts, row by row from the upper left.
struct GreyPicture {
    int width = 0, height = 0;
    int bits = 16;                     // 8 or 16
    std::vector<std::uint16_t> count;  // rounded; beyond the scale its ends, not finite 0
    std::string scale;                 // "K = 0 + 0.01 count"
    std::size_t beyond = 0;            // pixels above or below what the scale holds
};
GreyPicture grey_picture_of(const Frame& frame, const std::string& plane, int bits);

/// How many pixels of a plane lie beyond a scale; those that are not finite do not.
std::size_t pixels_beyond(const Plane& plane, const GreyScale& scale, int bits);

}  // namespace diurna
