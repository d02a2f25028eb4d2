#pragma once

#include <optional>

#include "thermal/weather/weather.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The span of a weather file: its first interval's start to its last one's end, or its first and
/// last instant.
struct CoveredSpan {
    Instant begin, end;
};
CoveredSpan covered_span(const WeatherTable& table, Stamp stamps);

/// The series of a table without gaps. A mean is assigned to the middle of its interval; states at
/// the stamps are interpolated to it. Humidity comes from the dew point, station pressure from the
/// altimeter setting (NWS: p = A (1 − 0.0065 h / 288)^5.2561), absent quantities from
/// WeatherTable's defaults, which the note reports.
///
/// elevation  [m] above the sea, of the place
Weather weather_series(const WeatherTable& table, Stamp stamps, double elevation);

/// Station pressure of an altimeter setting (QNH), both [Pa].
double station_pressure(double altimeter, double elevation);

}  // namespace diurna
