#pragma once

#include "thermal/weather/weather.hpp"

namespace diurna {

/// A long series without the rows that are not needed between two instants: those more than 40 days
/// before the first and more than 3 days after the last. Starts are compared with those of 31 more
/// days (thermal/solve/start_error.hpp), and clouds are held through a night; further rows would be
/// copied and searched with every span. A series of up to 100 000 rows is unchanged.
Weather cropped(Weather weather, Instant first, Instant last);

}  // namespace diurna
