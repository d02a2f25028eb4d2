#include "thermal/weather/wind_share.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

double wind_at_height(double height, double reference) {
    // (T8) of docs/theory.md
    constexpr double lowest = 0.5;  // [m]
    return std::log(std::max(height, lowest) / open_roughness) /
           std::log(std::max(reference, lowest) / open_roughness);
}

double lee_deficit(double distance, double obstacle, double height) {
    constexpr double most = 2.0 / 3.0, lowest = 2.0, least_obstacle = 0.3;  // [1], [m], [m]
    if (obstacle < least_obstacle || distance > lee_reach * obstacle) return 0.0;
    // (T9) of docs/theory.md
    const double away = std::max(distance / obstacle, 1.0);
    const double k = 2.0 * von_karman * von_karman / std::log(obstacle / open_roughness);
    const double eta = std::max(height, lowest) / obstacle * std::pow(k * away, -0.47);
    return std::min(most, 9.75 / away * eta * std::exp(-0.67 * eta * std::sqrt(eta)));
}

}  // namespace diurna
