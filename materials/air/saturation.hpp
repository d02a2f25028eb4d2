#pragma once

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"

/// Saturation vapour pressure after Murray (1967, J. Appl. Meteor. 6, 203): e = 610.78 Pa exp(a (T
/// − 273.16 K) / (T − b)); over water within 0.3 % of the steam tables from 260 to 320 K
/// (tests/materials/moist_air_test.cpp). Split into parts so that loops can be vectorised.
namespace diurna {

struct MurrayLaw {
    double a, b;  // b [K]: the formula's pole
};
inline constexpr MurrayLaw over_water{17.2693882, 35.86}, over_ice{21.8745584, 7.66};
inline constexpr double triple_point = 273.16;           // [K]
inline constexpr double triple_point_pressure = 610.78;  // [Pa]

/// The exponent at a temperature above the pole, `inverse` = 1 / (T − b).
inline double saturation_exponent(MurrayLaw law, double temperature, double inverse) {
    return law.a * (temperature - triple_point) * inverse;
}
/// de/dT from e [Pa K⁻¹].
inline double saturation_slope(MurrayLaw law, double pressure, double inverse) {
    return pressure * (law.a * (triple_point - law.b)) * inverse * inverse;
}

/// Limits of Murray's formula over water [K]: linear above, constant below.
inline constexpr double coldest_vapour = 100.0, hottest_vapour = 450.0;

/// Saturation vapour pressure over water [Pa] and, through `slope`, its derivative [Pa K⁻¹], for
/// scalar code and vectorised loops: no call, no branch. Above 450 K it continues as a straight
/// line, so that a surface hotter than boiling stays finite.
inline double saturation_over_water(double temperature, double& slope) {
    const double t = std::clamp(temperature, coldest_vapour, hottest_vapour);
    const double inverse = 1.0 / (t - over_water.b);
    const double pressure =
        triple_point_pressure * fast_exp(saturation_exponent(over_water, t, inverse));
    slope = saturation_slope(over_water, pressure, inverse);
    return pressure + slope * std::max(0.0, temperature - hottest_vapour);
}

/// Dew point [K] over water of a vapour pressure [Pa]; below 1 mPa that of 1 mPa.
inline double dew_point(double vapour_pressure) {
    const double l = std::log(std::max(vapour_pressure, 1e-3) / triple_point_pressure);
    return (over_water.a * triple_point - l * over_water.b) / (over_water.a - l);
}

}  // namespace diurna
