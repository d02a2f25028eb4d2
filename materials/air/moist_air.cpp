#include "materials/air/moist_air.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double molar_mass_ratio = 0.62198;  // water to dry air, 18.01528 / 28.9647

// Murray 1967 (J. Appl. Meteor. 6, 203): e = 610.78 exp(a (T − 273.16) / (T − b)) over water;
// within 0.3 % of Wexler's formula from 260 to 320 K.
constexpr double murray_a = 17.2693882;
constexpr double murray_b = 35.86;
constexpr double triple_point = 273.16;

// The formula has a pole at b; nothing here is colder than the mesopause.
double above_pole(double temperature) { return std::max(temperature, 100.0); }

}  // namespace

double air_density(const AirState& air) {
    // Dalton: dry air and vapour side by side, written as dry air of a virtual temperature.
    const double dry = 1.0 - (1.0 - molar_mass_ratio) * air.vapour_pressure / air.pressure;
    return air.pressure * dry / (dry_air_gas_constant * air.temperature);
}

double specific_humidity(const AirState& air) {
    return molar_mass_ratio * air.vapour_pressure /
           (air.pressure - (1.0 - molar_mass_ratio) * air.vapour_pressure);
}

double saturation_vapour_pressure(double temperature) {
    const double t = above_pole(temperature);
    return 610.78 * std::exp(murray_a * (t - triple_point) / (t - murray_b));
}

double saturation_vapour_pressure_derivative(double temperature) {
    if (temperature < 100.0) return 0.0;
    const double d = temperature - murray_b;
    return saturation_vapour_pressure(temperature) * murray_a * (triple_point - murray_b) / (d * d);
}

double latent_heat_of_vaporisation(double temperature) {
    // Linear fit of the steam tables (Stull 1988, p. 641): within 0.2 % from 250 to 320 K.
    return 2.501e6 - 2361.0 * (temperature - zero_celsius);
}

double dew_point(double vapour_pressure) {
    // Murray's formula solved for T; a vanishing vapour pressure has no dew point above the pole.
    const double x = std::log(std::max(vapour_pressure, 1e-6) / 610.78) / murray_a;
    return (triple_point - murray_b * x) / (1.0 - x);
}

double standard_pressure(double height) {
    // US Standard Atmosphere 1976: 6.5 K/km to 11 km, then isothermal at 216.65 K.
    constexpr double base = 288.15, lapse = 0.0065, tropopause = 11000.0, cold = 216.65;
    constexpr double air_gas_constant = 8.31432 / 0.0289644;
    constexpr double exponent = gravity / (air_gas_constant * lapse);
    const double below = std::min(height, tropopause);
    const double pressure = 101325.0 * std::pow(1.0 - lapse * below / base, exponent);
    return pressure * std::exp(-gravity * (height - below) / (air_gas_constant * cold));
}

}  // namespace diurna
