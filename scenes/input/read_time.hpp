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
    double utc_offset = 0.0;    // [s] that the scene's clock is ahead of UTC, as start says it
    double duration = 86400.0;  // [s]
    double step = 600.0;        // [s] of the heat balance
    SpanStart spin_up = SpanStart::known;
    int days_before = 3;          // of spin_up "weather", at most
    std::filesystem::path state;  // of an earlier run, for SpanStart::state
    std::string state_where;      // in the scene file
    std::vector<Instant> frames;  // ascending, within the span
    std::string frames_note{};    // days that have none
    bool every_step = false;      // temperatures are kept at each, for studies of all the time

    Instant end() const { return later(start, duration); }
};

/// site  for pictures that the sun's place says when to take
TimeInput read_time(const Section& section, const std::optional<Site>& site = {});

}  // namespace diurna
