#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "thermal/solve/clock_hours.hpp"

namespace diurna {

/// Texts of a key as "05:30-06:10 0.3", with a date before it if it is of one day: hours and the
/// share of a heat. Mistakes are noted.
std::vector<ClockHours::Window> windows_of(const Section& section, const char* key,
                                           const std::vector<std::string>& texts);
/// The key `hours` of what releases heat or is held at a temperature.
std::vector<ClockHours::Window> read_hours(const Section& section);

/// The key `runs` of what releases heat in the hours of the object's `running` alone.
bool read_runs(const Section& section);

}  // namespace diurna
