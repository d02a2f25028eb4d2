#pragma once

#include <string>

#include "render/picture/frame.hpp"

namespace diurna {

/// Ends of a scale, in `colour_unit` of the plane.
struct ColourScale {
    double low, high;
};
/// Of temperatures percentiles 1 and 99, widened to whole degrees; of others zero and percentile
/// 99. A series of pictures that shall share one takes the widest.
ColourScale colour_scale(const Plane& plane);
/// The same over the pixels that see a facet, if the frame has the plane `temperature` to tell
/// them by: a cold sky shall not take up the colours.
ColourScale colour_scale(const Frame& frame, const std::string& plane);
std::string colour_unit(const Plane& plane);

/// Temperatures are shown in °C, all else in the plane's own unit.
bool is_temperature(const Plane& plane);
double in_colour_unit(const Plane& plane, float value);

}  // namespace diurna
