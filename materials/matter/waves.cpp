#include "materials/matter/waves.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace diurna {

double mean_square_slope(double wind_speed) { return 0.003 + 0.00512 * std::max(0.0, wind_speed); }

double wind_over_water(double wind_speed, double height) {
    constexpr double roughness_length = 0.0002, reference = 12.5;
    return wind_speed * std::log(reference / roughness_length) /
           std::log(std::max(height, 0.1) / roughness_length);
}

double roughness_under(const Finish& finish, double wind_speed) {
    const auto* glossy = std::get_if<Glossy>(&finish);
    if (glossy == nullptr) return 0.0;
    return glossy->waves ? std::sqrt(mean_square_slope(wind_speed)) : glossy->roughness;
}

Material under_wind(const Material& material, double wind_speed) {
    Material moved = material;
    if (auto* glossy = std::get_if<Glossy>(&moved.finish)) {
        glossy->roughness = roughness_under(material.finish, wind_speed);
    }
    return moved;
}

}  // namespace diurna
