#pragma once

#include <vector>

#include "materials/base/section.hpp"
#include "terrain/place/instant.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// The section [time]: the span, its steps, its start and its pictures.
struct TimeInput {
    Instant start;
    double duration = 86400.0;  // [s]
    double step = 600.0;        // [s] of the heat balance
    SpanStart spin_up = SpanStart::known;
    int days_before = 3;          // of spin_up "weather", at most
    std::vector<Instant> frames;  // ascending, within the span

    Instant end() const { return later(start, duration); }
};

TimeInput read_time(const Section& section);

}  // namespace diurna
