#pragma once

#include <optional>
#include <string_view>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The quantity that a column's name looks like: by its words ("wind_kmh", "windSpeed", "rh",
/// "ghi", "Dew Point") or a letter or two from a known name. None for others, and for what only
/// begins like one: directions, gusts, flags, clear-sky models, extremes.
std::optional<Quantity> looks_like(std::string_view column);

/// Adds a warning for each column that was passed over (`unused`), looks like a quantity and is the
/// only one of it: the quantity falls back to its default, and a wind of 1 m/s that nobody measured
/// changes temperatures by kelvins.
void warn_of_unused_columns(WeatherTable& table);

}  // namespace diurna
