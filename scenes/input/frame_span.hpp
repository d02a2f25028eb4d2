#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Within which instants pictures may be taken, and when they are taken by default.
struct FrameSpan {
    Instant begin, end;
    std::string said = "the span of [time]";
    double utc_offset = 0.0;     // [s] that the clock of windows is ahead of UTC
    double every = 3600.0;       // [s] by default
    std::string every_said{};    // in the page of keys
    std::optional<Site> site{};  // for those the sun says; none: the raster's middle, not known yet
};

/// When pictures are taken.
struct Frames {
    std::vector<Instant> frame;  // ascending, within the span
    std::string note{};          // days on which the sun does not get where it is waited for
};

}  // namespace diurna
