#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// The section [time]: the span, its steps, its start and its pictures.
struct TimeInput {
    Instant start;
    double utc_offset = 0.0;    // [s] scene's clock ahead of UTC, from start
    double duration = 86400.0;  // [s]
    double step = 600.0;        // [s] of the heat balance
    SpanStart spin_up = SpanStart::known;
    int days_before = 3;          // maximum for spin_up "weather"
    std::filesystem::path state;  // of an earlier run, for SpanStart::state
    std::string state_where;      // in the scene file
    std::vector<Instant> frames;  // ascending, within the span
    std::string frames_note{};    // days without frames
    bool every_step = false;      // temperatures are stored at each, for studies over time

    Instant end() const { return later(start, duration); }
};

/// site  for pictures at given sun positions
TimeInput read_time(const Section& section, const std::optional<Site>& site = {});

}  // namespace diurna
