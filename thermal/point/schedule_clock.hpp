#pragma once

#include <string>

#include "materials/matter/material.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// A schedule's value at an instant, straight between its entries and around midnight, on a clock
/// that is utc_offset [s] ahead of UTC; `otherwise` where the schedule is empty.
double scheduled(const Schedule& schedule, double otherwise, double utc_offset, Instant when);

/// The schedule that a surface has: "internal_schedule", "bottom.schedule" (of a room), or "".
std::string schedule_key(const ThermalSurface& surface);

/// Schedules followed local mean solar time before; now they follow the clock of time.start, as
/// hours at which objects run do. What that changes at a site: "hours are on the clock of
/// time.start, UTC-04:00; ...". "" where the two differ by less than a minute.
std::string schedule_clock_note(const Site& site, double utc_offset);

}  // namespace diurna
