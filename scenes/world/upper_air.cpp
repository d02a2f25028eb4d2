#include "scenes/world/upper_air.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/air/seasonal_profile.hpp"

namespace diurna {

namespace {

constexpr double an_hour = 3600.0;

double mean_temperature(const Weather& weather, Instant from, Instant to) {
    const double span = std::max(24.0 * an_hour, seconds_between(from, to));
    double sum = 0.0;
    int hours = 0;
    for (; an_hour * hours < span; ++hours) {
        sum += weather.air_at(later(from, an_hour * hours)).temperature;
    }
    return sum / hours;
}

std::shared_ptr<const Profile> of_season(const Weather& weather, double temperature) {
    return std::make_shared<const Profile>(seasonal_profile(weather.height / 1000.0, temperature));
}

}  // namespace

std::shared_ptr<const Profile> upper_air(const Scene& scene, const Weather& weather) {
    const AirInput& air = scene.air;
    if (air.sounding) return air.sounding;
    if (!air.by_season) return std::make_shared<const Profile>(afgl_profile(air.profile));
    if (weather.above) return weather.above;
    return of_season(weather,
                     mean_temperature(weather, weather.instant.front(), weather.instant.back()));
}

void take_upper_air(const Scene& scene, Instant from, Instant to, Weather& weather) {
    if (scene.air.sounding || scene.air.table || !scene.air.by_season) return;
    const double mean = mean_temperature(weather, from, to);
    weather.above = of_season(weather, mean);
    weather.note +=
        fmt::format("{}air above the ground from the mean temperature, {:.1f} K: AFGL {}",
                    weather.note.empty() ? "" : "; ", mean, weather.above->name);
}

}  // namespace diurna
