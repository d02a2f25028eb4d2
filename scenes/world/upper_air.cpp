#include "scenes/world/upper_air.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "materials/air/seasonal_profile.hpp"

namespace diurna {

namespace {

/// By the hour.
double mean_temperature(const Weather& weather, Instant from, Instant to) {
    double sum = 0.0;
    int hours = 0;
    for (Instant at = from; at < to || hours == 0; at += std::chrono::hours(1), ++hours) {
        sum += weather.air_at(at).temperature;
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

void take_upper_air(const Scene& scene, double longitude_deg, Weather& weather) {
    if (scene.air.sounding || scene.air.vacuum || !scene.air.by_season) return;
    using std::chrono::days;
    const Instant::duration ahead(std::llround(longitude_deg / 360.0 * 86400e3));
    const Instant from = std::max(std::chrono::floor<days>(scene.time.start + ahead) - ahead,
                                  weather.instant.front());
    const Instant to =
        std::min(std::chrono::ceil<days>(scene.time.end() + ahead) - ahead, weather.instant.back());
    const double mean = mean_temperature(weather, from, to);
    weather.above = of_season(weather, mean);
    if (scene.air.table) return;
    weather.note +=
        fmt::format("{}air above the ground from the mean temperature, {:.1f} K: AFGL {}",
                    weather.note.empty() ? "" : "; ", mean, weather.above->name);
}

}  // namespace diurna
