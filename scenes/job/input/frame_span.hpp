#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// The allowed span of pictures, and their default times.
struct FrameSpan {
    Instant begin, end;
    std::string said = "the span of [time]";
    double utc_offset = 0.0;     // [s] clock of windows ahead of UTC
    double every = 3600.0;       // [s] by default
    std::string every_said{};    // in the page of keys
    std::optional<Site> site{};  // for frames_at_sun; none: the raster's middle, not known yet
};

/// Instants of pictures.
struct Frames {
    std::vector<Instant> frame;  // ascending, within the span
    std::string note{};          // days on which the sun does not reach the requested position
};

}  // namespace diurna
