#pragma once

#include "materials/base/section.hpp"
#include "scenes/job/input/frame_span.hpp"

namespace diurna {

/// The table `frames_at_sun`: a picture whenever the sun reaches an azimuth, or an elevation.
Frames read_frames_at_sun(const Section& section, const FrameSpan& span);

}  // namespace diurna
