#include "thermal/weather/sky_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

/// What open level ground takes of the even functions.
constexpr std::array<double, even_sky_functions> level = {1.0, 2.0 / 3.0, 0.5, 0.5};

/// Even functions about a sun as functions east-north-up: each order turns within itself.
SkyVector turned(const std::array<double, even_sky_functions>& even, double azimuth) {
    SkyVector all{};
    for (std::size_t k = 0; k < even.size(); ++k) {
        const std::size_t at = even_sky_function[k];
        const double turn = sky_order[k] * azimuth;
        all[at] = static_cast<float>(even[k] * std::cos(turn));
        if (sky_order[k] > 0) all[at + 1] = static_cast<float>(even[k] * std::sin(turn));
    }
    return all;
}

}  // namespace

DiffuseSplit SkySpreads::at(Instant when, const Eigen::Vector3d& to_sun) const {
    const auto next = std::upper_bound(instant.begin(), instant.end(), when);
    const std::size_t last = spread.size() - 1;
    const auto after = std::min(static_cast<std::size_t>(next - instant.begin()), last);
    const std::size_t before = after > 0 && next != instant.begin() ? after - 1 : after;
    double share = 0.0;
    if (after != before) {
        share = std::min(1.0, seconds_between(instant[before], when) /
                                  seconds_between(instant[before], instant[after]));
    }
    DiffuseSplit split{.by_air = true};
    split.circumsolar = std::lerp(spread[before].circumsolar, spread[after].circumsolar, share);
    std::array<double, even_sky_functions> even{};
    for (std::size_t k = 1; k < even.size(); ++k) {
        even[k] = std::numbers::pi * std::lerp(double{spread[before].uneven[k - 1]},
                                               double{spread[after].uneven[k - 1]}, share);
        even[0] -= even[k] * level[k];
    }
    split.uneven = turned(even, std::atan2(to_sun.y(), to_sun.x()));
    return split;
}

}  // namespace diurna
