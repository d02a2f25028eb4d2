#pragma once

#include "materials/base/section.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// What is made of measured weather, to ask what follows from its errors or from other weather.
struct WeatherChange {
    double warmer = 0.0;    // [K] added to the air's temperature; its vapour pressure stays
    double wind = 1.0;      // factor on its speed
    double humidity = 1.0;  // factor on its vapour pressure, at most to saturation over water
    double sunlight = 1.0;  // factor on what was measured of it
    double longwave = 1.0;  // factor on what was measured of the sky's; a modelled one follows air

    bool operator==(const WeatherChange&) const = default;
};

/// [weather.changed].
WeatherChange read_weather_change(const Section& weather);

/// Changes every sample, and says so in the note; changes nothing where nothing is asked. Throws
/// InputError at `where` for a factor on what nobody measured, which would do nothing.
void change_weather(Weather& weather, const WeatherChange& change, const std::string& where);

}  // namespace diurna
