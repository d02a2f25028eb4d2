#pragma once

#include <optional>
#include <string_view>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The quantity that a column's name resembles: by its words ("wind_kmh", "windSpeed", "rh", "ghi",
/// "Dew Point") or a letter or two from a known name. None for others, and for names that only
/// begin like one: directions, gusts, flags, clear-sky models, extremes.
std::optional<Quantity> looks_like(std::string_view column);

/// Adds a warning for each skipped column (`unused`) that resembles a quantity for which there is
/// no other column: the quantity then has its default, and a default wind of 1 m/s changes
/// temperatures by kelvins.
void warn_of_unused_columns(WeatherTable& table);

}  // namespace diurna
