#pragma once

#include <array>
#include <cstdint>

namespace diurna {

using Rgb = std::array<std::uint8_t, 3>;  // sRGB

/// Colour of a temperature at t in [0, 1] of its scale: from night violet over red to warm white.
/// Lightness L* rises evenly from 8 to 95, so that equal steps look equal; as colourful as sRGB
/// can show. CIE 15:2018 (L*C*h, D65), IEC 61966-2-1.
Rgb warm_colour(double t);

/// The grey that sends t in [0, 1] of the light of white: radiance shown as a photograph.
Rgb grey_of_light(double t);

}  // namespace diurna
