#pragma once

#include <string>

#include "materials/matter/material.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// A schedule's value at an instant, linear between its entries and across midnight, on a clock
/// that is utc_offset [s] ahead of UTC; `otherwise` if the schedule is empty.
double scheduled(const Schedule& schedule, double otherwise, double utc_offset, Instant when);

/// The key of a surface's schedule: "internal_schedule", "bottom.schedule" (of a room), or "".
std::string schedule_key(const ThermalSurface& surface);

/// Schedules used local mean solar time in earlier versions; now they use the clock of time.start,
/// like the hours at which objects run. The effect at a site: "hours are on the clock of
/// time.start, UTC-04:00; ...". "" if the two differ by less than a minute.
std::string schedule_clock_note(const Site& site, double utc_offset);

}  // namespace diurna
