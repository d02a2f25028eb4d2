#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

/// Within which instants pictures may be taken, and when they are taken by default.
struct FrameSpan {
    Instant begin, end;
    double utc_offset = 0.0;   // [s] that the clock of windows is ahead of UTC
    double every = 3600.0;     // [s] by default
    std::string every_said{};  // in the page of keys
};

/// The keys `frames` and `frame_every_s`: instants, ascending, within the span.
std::vector<Instant> read_frames(const Section& section, const FrameSpan& span);

}  // namespace diurna
