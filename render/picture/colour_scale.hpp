#pragma once

#include <string>

#include "render/picture/frame.hpp"

namespace diurna {

/// Ends of a scale, in `colour_unit` of the plane.
struct ColourScale {
    double low, high;
};
/// For temperatures percentiles 1 and 99, widened to whole degrees; for others zero and percentile
/// 99. A series of pictures with a common scale uses the widest.
ColourScale colour_scale(const Plane& plane);
/// The same over the pixels that see a facet, if the frame has the plane `temperature` to identify
/// them: a cold sky would use up the colours.
ColourScale colour_scale(const Frame& frame, const std::string& plane);
std::string colour_unit(const Plane& plane);

/// Temperatures are shown in °C, other quantities in the plane's unit.
bool is_temperature(const Plane& plane);
double in_colour_unit(const Plane& plane, float value);

}  // namespace diurna
