#pragma once

#include <optional>

#include "terrain/place/site.hpp"
#include "thermal/weather_file/typical_year.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// Treatment of values that are missing for longer than `longest_small_gap`.
enum class OnGap {
    refuse,
    interpolate,  // linear from the last to the next value
    clear_sky,    // radiation stays unmeasured, for the clear sky's formulas; others linear
};

inline constexpr double longest_small_gap = 3.0 * 3600.0;  // [s] between the values around it

/// Fills missing values: absent rows (intervals longer than 1.5 times the file's
/// usual one), and cells of temperature, humidity, pressure, wind and radiation.
/// Small gaps are interpolated linearly, larger ones as `on_gap` says; only
/// those within the requested span, and the range before and after it that its
/// start uses, are refused or counted. Before the first and after the last value
/// a state is held; radiation is left unmeasured. Sunlight of empty cells at
/// night is zero, if a site is given. The notes count every value that was
/// filled.
///
/// Throws InputError at the first large gap within the span, if they are refused, or if a file has
/// no air temperature at all.
void fill_gaps(WeatherTable& table, OnGap on_gap, const AskedSpan& asked,
               const std::optional<Site>& site);

}  // namespace diurna
