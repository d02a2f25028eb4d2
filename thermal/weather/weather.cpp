#include "thermal/weather/weather.hpp"

#include <algorithm>

namespace diurna {

namespace {

AirState on_line(const AirState& a, const AirState& b, double share) {
    return {.temperature = a.temperature + share * (b.temperature - a.temperature),
            .pressure = a.pressure + share * (b.pressure - a.pressure),
            .vapour_pressure = a.vapour_pressure + share * (b.vapour_pressure - a.vapour_pressure)};
}

/// The samples before and after an instant, and how far it is on the way.
struct BetweenSamples {
    std::size_t before, after;
    double share;
};
BetweenSamples place_of(const Weather& weather, Instant when) {
    const auto& instant = weather.instant;
    const auto next = std::upper_bound(instant.begin(), instant.end(), when);
    if (next == instant.begin()) return {0, 0, 0.0};
    const auto i = static_cast<std::size_t>(next - instant.begin());
    if (next == instant.end()) return {i - 1, i - 1, 0.0};
    return {i - 1, i,
            seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i])};
}

}  // namespace

Forcing between(const Forcing& a, const Forcing& b, double share) {
    const auto mix = [&](double Forcing::*member) {
        return a.*member + share * (b.*member - a.*member);
    };
    return {.air = on_line(a.air, b.air, share),
            .wind_speed = mix(&Forcing::wind_speed),
            .rain_mm_h = mix(&Forcing::rain_mm_h),
            .cloud_fraction = mix(&Forcing::cloud_fraction),
            .shortwave_down = mix(&Forcing::shortwave_down),
            .direct_normal = mix(&Forcing::direct_normal),
            .diffuse = mix(&Forcing::diffuse),
            .shortwave_up = mix(&Forcing::shortwave_up),
            .plane_of_array = mix(&Forcing::plane_of_array),
            .longwave_down = mix(&Forcing::longwave_down)};
}

AirState Weather::air_at(Instant when) const {
    const BetweenSamples place = place_of(*this, when);
    if (place.share == 0.0) return sample[place.before].air;
    return on_line(sample[place.before].air, sample[place.after].air, place.share);
}

Forcing Weather::at(Instant when) const {
    const BetweenSamples place = place_of(*this, when);
    const Forcing &a = sample[place.before], &b = sample[place.after];
    Forcing now = place.share == 0.0 ? a : between(a, b, place.share);
    if (span_of(place.before) > 0.0 || span_of(place.after) > 0.0) {
        // A mean of rain is a sum that fell within its interval.
        const auto holds = [&](std::size_t i) {
            return std::abs(seconds_between(instant[i], when)) <= 0.5 * span_of(i);
        };
        now.rain_mm_h = holds(place.before) ? a.rain_mm_h : holds(place.after) ? b.rain_mm_h : 0.0;
    }
    return now;
}

}  // namespace diurna
