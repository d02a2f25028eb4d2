#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/frame.hpp"

namespace diurna {

/// Meaning of the counts of a grey picture: value = zero + step × count.
struct GreyScale {
    double zero = 0.0, step = 1.0;  // in the plane's unit
};

/// The scale of a plane in a picture of 8 or 16 bits.
///
/// - 16 bits: 0.01 K from 0 K for temperatures, as in files of radiometric cameras; from 0 in
///   steps of 1, 2 or 5 times a power of ten for other quantities, the finest that includes the
///   maximum
/// - 8 bits: the ends of the quick-look's colours (colour_scale.hpp), to keep a frame's contrast
GreyScale grey_scale(const Frame& frame, const std::string& plane, int bits);

/// The counts shown as black and white by a viewer: for 8 bits all of them, for 16 those of the
/// ends of the quick-look's colours. In 16 bits of 0.01 K a scene covers a few thousand of 65536
/// counts, and a viewer that shows the upper 8 bits has 2 to 10 levels.
struct DisplayCounts {
    int black = 0, white = 255;  // white is above black
};
DisplayCounts display_counts(const Frame& frame, const std::string& plane, int bits);

/// A plane as counts, row by row from the upper left.
struct GreyPicture {
    int width = 0, height = 0;
    int bits = 16;                     // 8 or 16
    std::vector<std::uint16_t> count;  // rounded; clipped to the scale, 0 if not finite
    std::string scale;                 // "K = 0 + 0.01 count"
    std::size_t beyond = 0;            // pixels outside the scale
};
GreyPicture grey_picture_of(const Frame& frame, const std::string& plane, int bits);

/// Number of pixels of a plane outside a scale; those that are not finite do not count.
std::size_t pixels_beyond(const Plane& plane, const GreyScale& scale, int bits);

}  // namespace diurna
