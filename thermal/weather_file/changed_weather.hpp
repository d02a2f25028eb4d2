#pragma once

#include "materials/base/section.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Changes of measured weather, to examine the effect of its errors or of other weather.
struct WeatherChange {
    double warmer = 0.0;    // [K] added to the air's temperature; its vapour pressure stays
    double wind = 1.0;      // factor on its speed
    double humidity = 1.0;  // factor on its vapour pressure, at most to saturation over water
    double sunlight = 1.0;  // factor on measured sunlight
    double longwave = 1.0;  // factor on measured longwave; modelled longwave follows the air

    bool operator==(const WeatherChange&) const = default;
};

/// [weather.changed].
WeatherChange read_weather_change(const Section& weather);

/// Changes every sample, and says so in the note; no effect without changes. Throws InputError at
/// `where` for a factor on values that were not measured, which would have no effect.
void change_weather(Weather& weather, const WeatherChange& change, const std::string& where);

}  // namespace diurna
