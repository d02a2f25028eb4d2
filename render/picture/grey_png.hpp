#pragma once

#include <filesystem>

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

/// A plane as a grey PNG of its very pixels, without margins, title or bar: for programs that learn
/// from pictures. Counts are rounded; what is beyond the scale has its ends, what is not finite 0.
/// The scale is returned and stands in the file's text, "Scale" ("K = 0 + 0.01 count").
GreyScale write_grey_png(const std::filesystem::path& path, const Frame& frame,
                         const std::string& plane, int bits);

}  // namespace diurna
