#include "materials/air/moist_air.hpp"

#include <algorithm>
#include <cmath>

#include "materials/air/saturation.hpp"
#include "materials/base/units.hpp"

namespace diurna {

double air_density(const AirState& air) {
    // Dalton: dry air and vapour side by side, written as dry air of a virtual temperature.
    const double dry = 1.0 - (1.0 - water_over_dry_air) * air.vapour_pressure / air.pressure;
    return air.pressure * dry / (dry_air_gas_constant * air.temperature);
}

double saturation_vapour_pressure(double temperature) {
    // (T12) of docs/theory.md has a pole; nothing here is colder than the mesopause.
    const double t = std::max(temperature, coldest_vapour);
    return triple_point_pressure * std::exp(over_water.a * (t - triple_point) / (t - over_water.b));
}

double latent_heat_of_vaporisation(double temperature) {
    // Linear fit of the steam tables (Stull 1988, p. 641): within 0.2 % from 250 to 320 K.
    return 2.501e6 - 2361.0 * (temperature - zero_celsius);
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
