#include "thermal/weather/weather_section.hpp"

namespace diurna {

WeatherOptions read_weather_options(const Section& section, Stamp interval, double lowest_wind) {
    return {
        .interval = section.choice_or(
            "interval",
            "a row is the mean over the time that starts or ends at its stamp, or is of that "
            "instant",
            interval, {{"start", Stamp::start}, {"end", Stamp::end}, {"instant", Stamp::instant}}),
        .wind_height = section.number_or("wind_height_m", "at which wind was measured", 10.0,
                                         {lowest_wind, 200.0}),
        .air_height = section.number_or("air_height_m",
                                        "at which the air's temperature and humidity were measured",
                                        2.0, {0.1, 200.0})};
}

}  // namespace diurna
