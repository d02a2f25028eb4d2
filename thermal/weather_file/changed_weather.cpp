#include "thermal/weather_file/changed_weather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

bool is_measured(double value) { return !std::isnan(value); }

/// Times a factor; whether any of them was measured.
bool scale(double factor, std::initializer_list<double*> fluxes) {
    bool any = false;
    for (double* flux : fluxes) {
        any |= is_measured(*flux);
        *flux *= factor;
    }
    return any;
}

}  // namespace

WeatherChange read_weather_change(const Section& weather) {
    const Section section =
        weather.section("changed", "changes of the weather, to study the effect of its errors");
    constexpr Range factors{0.0, 10.0};
    WeatherChange change;
    change.warmer = section.number_or(
        "air_temperature_offset_K",
        "added to air temperature; vapour pressure is unchanged, at most at saturation",
        change.warmer, {-50.0, 50.0});
    change.wind = section.number_or("wind_factor", "factor on wind speed", change.wind, factors);
    change.humidity =
        section.number_or("humidity_factor", "factor on vapour pressure, at most to saturation",
                          change.humidity, factors);
    change.sunlight = section.number_or("sunlight_factor", "factor on all measured sunlight",
                                        change.sunlight, factors);
    change.longwave = section.number_or(
        "longwave_factor",
        "factor on measured longwave radiation of the sky; modelled radiation follows the air",
        change.longwave, factors);
    return change;
}

void change_weather(Weather& weather, const WeatherChange& change, const std::string& where) {
    if (change == WeatherChange{}) return;  // what was measured stays, supersaturated or not
    bool sun = false, sky = false;
    for (Forcing& sample : weather.sample) {
        AirState& air = sample.air;
        if (change.warmer != 0.0 || change.humidity != 1.0) {
            air.temperature += change.warmer;
            air.vapour_pressure = std::min(air.vapour_pressure * change.humidity,
                                           saturation_vapour_pressure(air.temperature));
        }
        sample.wind_speed *= change.wind;
        sun |=
            scale(change.sunlight, {&sample.shortwave_down, &sample.direct_normal, &sample.diffuse,
                                    &sample.shortwave_up, &sample.plane_of_array});
        sky |= scale(change.longwave, {&sample.longwave_down});
    }
    std::string reported;
    const auto tell = [&](double value, double usual, const char* what) {
        if (value != usual)
            reported += fmt::format("{}{} {:g}", reported.empty() ? "" : ", ", what, value);
    };
    tell(change.warmer, 0.0, "air + K");
    tell(change.wind, 1.0, "wind x");
    tell(change.humidity, 1.0, "humidity x");
    tell(change.sunlight, 1.0, "sunlight x");
    tell(change.longwave, 1.0, "longwave x");
    if (change.sunlight != 1.0 && !sun) {
        throw InputError(where + ".sunlight_factor", "the file has no measured sunlight");
    }
    if (change.longwave != 1.0 && !sky) {
        throw InputError(where + ".longwave_factor", "the file has no measured longwave");
    }
    weather.note += (weather.note.empty() ? "" : "; ") + ("changed: " + reported);
}

}  // namespace diurna
