#pragma once

#include <optional>

#include "terrain/place/site.hpp"
#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// What to do about values that are missing for longer than `longest_small_gap`.
enum class OnGap {
    refuse,
    interpolate,  // straight from the last to the next
    clear_sky,  // radiation stays unmeasured there, for the clear sky's formulas; the rest as above
};

inline constexpr double longest_small_gap = 3.0 * 3600.0;  // [s] between the values around it

/// Fills what is missing: rows that are not there, further apart than half as much again as the
/// file's usual interval, and cells of temperature, humidity, pressure, wind and radiation. Small
/// gaps are filled on the straight line between the values around them, larger ones as `on_gap`
/// says; only those within the asked span, and what its start uses before
/// and behind it, are refused or counted. Before the first and behind the
/// last value a state is held; radiation is left unmeasured. Sunlight of empty cells at night is
/// none, where a site reports what night is. The notes count every value that was filled.
///
/// Throws InputError at the first large gap within the span, if they are refused, or if a file has
/// no air temperature at all.
void fill_gaps(WeatherTable& table, OnGap on_gap, const AskedSpan& asked,
               const std::optional<Site>& site);

}  // namespace diurna
