#include "thermal/weather/repeated_day.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// A window [s] that follows (or goes before) a day's both ends within the series, of the same
/// hours of the day, an hour at most; nothing where the series is that day alone.
double common_window(const Weather& weather, Instant start) {
    constexpr double hour = 3600.0;
    const Instant end = later(start, seconds_of_day);
    const double after = seconds_between(end, weather.instant.back());
    const double before = seconds_between(weather.instant.front(), start);
    if (after > 0.0 && after >= std::min(before, hour)) return std::min(after, hour);
    return before > 0.0 ? -std::min(before, hour) : 0.0;
}

/// What a day's air and sky gain from its start to its end.
struct Trend {
    double warmer = 0.0, moister = 0.0;  // [K], [Pa]
    double brighter = 0.0;               // [W m⁻²] of longwave; NaN if it is not known
};

Trend trend_of(const Weather& weather, Instant start) {
    const double window = common_window(weather, start);
    const Instant end = later(start, seconds_of_day);
    const auto mean = [&](Instant from, double Forcing::*flux, double AirState::*air) {
        double sum = 0.0;
        constexpr int parts = 12;
        for (int i = 0; i < parts; ++i) {
            const Forcing f = weather.at(later(from, window * (i + 0.5) / parts));
            sum += flux ? f.*flux : f.air.*air;
        }
        return sum / parts;
    };
    const auto gain = [&](double Forcing::*flux, double AirState::*air) {
        return mean(end, flux, air) - mean(start, flux, air);
    };
    return {gain(nullptr, &AirState::temperature), gain(nullptr, &AirState::vapour_pressure),
            gain(&Forcing::longwave_down, nullptr)};
}

}  // namespace

bool has_trend(const Weather& weather, Instant start) {
    constexpr double least = 1e-6;  // [K], [Pa], [W m⁻²]
    const auto [warmer, moister, brighter] = trend_of(weather, start);
    const double sky = std::isnan(brighter) ? 0.0 : brighter;
    return std::max({std::abs(warmer), std::abs(moister), std::abs(sky)}) > least;
}

Weather without_trend(Weather weather, Instant start) {
    const auto [warmer, moister, brighter] = trend_of(weather, start);
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const double share =
            std::clamp(seconds_between(start, weather.instant[i]) / seconds_of_day, 0.0, 1.0);
        Forcing& f = weather.sample[i];
        f.air.temperature -= share * warmer;
        f.air.vapour_pressure = std::clamp(f.air.vapour_pressure - share * moister, 0.0,
                                           saturation_vapour_pressure(f.air.temperature));
        if (!std::isnan(brighter)) f.longwave_down -= share * brighter;
    }
    return weather;
}

bool repeats(const Weather& weather, Instant start) {
    const Forcing a = weather.at(start), b = weather.at(later(start, seconds_of_day));
    const auto near = [](double one, double other, double within) {
        return std::isnan(one) ? std::isnan(other) : std::abs(one - other) <= within;
    };
    return near(a.air.temperature, b.air.temperature, 0.2) &&
           near(a.air.vapour_pressure, b.air.vapour_pressure, 20.0) &&
           near(a.wind_speed, b.wind_speed, 0.2) && near(a.longwave_down, b.longwave_down, 2.0);
}

}  // namespace diurna
