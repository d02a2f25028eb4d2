#pragma once

#include <array>
#include <cstdint>

namespace diurna {

using Rgb = std::array<std::uint8_t, 3>;  // sRGB

/// Colour of a temperature at t in [0, 1] of its scale: from dark violet over red to warm white.
/// Lightness L* rises linearly from 8 to 95, so that equal steps look equal; with the highest
/// chroma that sRGB allows. CIE 15:2018 (L*C*h, D65), IEC 61966-2-1.
Rgb warm_colour(double t);

/// The grey with luminance t in [0, 1] of white: radiance shown as a photograph.
Rgb grey_of_light(double t);

}  // namespace diurna
