#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "thermal/solve/clock_hours.hpp"

namespace diurna {

/// Values of a key such as "05:30-06:10 0.3", with a date before it for a single day: hours and the
/// share of full power. Mistakes are noted.
std::vector<ClockHours::Window> windows_of(const Section& section, const char* key,
                                           const std::vector<std::string>& texts);
/// The key `hours` of a heat source or of a part with a given temperature.
std::vector<ClockHours::Window> read_hours(const Section& section);

/// The key `runs` of a source that is active only in the hours of the object's `running`.
bool read_runs(const Section& section);

}  // namespace diurna
