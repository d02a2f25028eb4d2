#pragma once

#include <cmath>

namespace diurna::testing {

/// Planck's law over 8 to 12 µm by Simpson's rule [W m⁻² sr⁻¹].
inline double black_band(double kelvin) {
    constexpr double c1 = 1.191042972e8, c2 = 1.438776877e4;  // W µm⁴ m⁻² sr⁻¹, µm K
    double sum = 0.0;
    constexpr int n = 400;
    for (int i = 0; i <= n; ++i) {
        const double um = 8.0 + 4.0 * i / n;
        const double weight = i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * c1 / (std::pow(um, 5) * (std::exp(c2 / (um * kelvin)) - 1.0));
    }
    return sum * 4.0 / n / 3.0;
}

}  // namespace diurna::testing
