#pragma once

#include "thermal/weather/weather.hpp"

namespace diurna {

/// A long series without the rows that nothing between two instants needs: those more than 40 days
/// before the first and more than 3 days behind the last. Starts are compared with those of 31 more
/// days (thermal/solve/start_error.hpp), and clouds are held through a night; rows beyond would be
/// copied and searched with every span. A series of 100 000 rows or fewer stays as it is.
Weather cropped(Weather weather, Instant first, Instant last);

}  // namespace diurna
