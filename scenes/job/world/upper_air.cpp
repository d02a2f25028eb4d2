#include "scenes/job/world/upper_air.hpp"

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

/// Days that are much colder or warmer than the mean share its air: clear longwave is off by about
/// 1.5 W/m2 for each kelvin.
void warn_of_many_seasons(const Scene& scene, Instant from, Instant to, double mean,
                          Weather& weather) {
    constexpr double far = 6.0;  // [K]
    const bool modelled = std::any_of(weather.sample.begin(), weather.sample.end(),
                                      [](const Forcing& f) { return std::isnan(f.longwave_down); });
    double coldest = mean, warmest = mean;
    for (Instant day = from; day < to; day += std::chrono::days(1)) {
        const double here = mean_temperature(weather, day, day + std::chrono::days(1));
        coldest = std::min(coldest, here);
        warmest = std::max(warmest, here);
    }
    if (!modelled || std::max(mean - coldest, warmest - mean) < far) return;
    weather.warnings.push_back(
        {fmt::format("{}: atmosphere.profile", scene.file.string()),
         fmt::format("days of {:.0f} to {:.0f} K have the air of their mean, {:.0f} K, above the "
                     "ground: clear longwave is off by up to {:.0f} W/m2",
                     coldest, warmest, mean, 1.5 * std::max(mean - coldest, warmest - mean)),
         "divide the span into runs of some days, or measure longwave_down_W_m2"});
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
    if (scene.air.drives_heat) warn_of_many_seasons(scene, from, to, mean, weather);
    weather.note +=
        fmt::format("{}air above the ground from the mean temperature, {:.1f} K: AFGL {}",
                    weather.note.empty() ? "" : "; ", mean, weather.above->name);
}

}  // namespace diurna
