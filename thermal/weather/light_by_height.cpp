#include "thermal/weather/light_by_height.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diurna {

namespace {

LightRatio mixed(const LightRatio& a, const LightRatio& b, double share) {
    return {.direct = std::lerp(a.direct, b.direct, share),
            .diffuse = std::lerp(a.diffuse, b.diffuse, share),
            .longwave = std::lerp(a.longwave, b.longwave, share)};
}

/// Place of a value among ascending ones: the one at or below it, and the share of the way on.
template <class Value, class Distance>
std::pair<std::size_t, double> place_among(const std::vector<Value>& values, const Value& value,
                                           const Distance& distance) {
    const auto next = std::upper_bound(values.begin(), values.end(), value);
    if (next == values.begin()) return {0, 0.0};
    const auto low = static_cast<std::size_t>(next - values.begin()) - 1;
    if (next == values.end()) return {low, 0.0};
    return {low, distance(values[low], value) / distance(values[low], *next)};
}

}  // namespace

ClearSky reference_sky(ClearSky clear) {
    constexpr double usual_380nm = 0.52, usual_500nm = 0.36;
    clear.aerosol_380nm = std::min(clear.aerosol_380nm, usual_380nm);
    clear.aerosol_500nm = std::min(clear.aerosol_500nm, usual_500nm);
    return clear;
}

LightRatio LightByHeight::at(Instant when, double at_height) const {
    const auto [i, later_share] = place_among(
        instant, when, [](Instant from, Instant to) { return seconds_between(from, to); });
    const auto [k, up_share] =
        place_among(height, at_height, [](double from, double to) { return to - from; });
    const std::size_t heights = height.size();
    const std::size_t up = std::min(k + 1, heights - 1);
    const auto of_instant = [&](std::size_t at_instant) {
        const LightRatio* const row = &ratio[at_instant * heights];
        return mixed(row[k], row[up], up_share);
    };
    return mixed(of_instant(i), of_instant(std::min(i + 1, instant.size() - 1)), later_share);
}

std::vector<double> LightByHeight::edges() const {
    constexpr double half = 0.25;  // [m]
    if (!std::isfinite(cloud_top)) return {};
    return {cloud_top - half, cloud_top + half};
}

}  // namespace diurna
