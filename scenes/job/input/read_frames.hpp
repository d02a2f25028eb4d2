#pragma once

#include "materials/base/section.hpp"
#include "scenes/job/input/frame_span.hpp"

namespace diurna {

/// The keys `frames`, `frame_every_s` and `frames_at_sun`.
Frames read_frames(const Section& section, const FrameSpan& span);

}  // namespace diurna
