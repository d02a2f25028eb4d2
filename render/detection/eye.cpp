#include "render/detection/eye.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

constexpr double mrad_per_degree = 1000.0 * std::numbers::pi / 180.0;
constexpr double foot_lambert = 3.4262591;  // [cd/m²]

/// Straight between the entries of a table, its ends beyond.
template <std::size_t n>
double between(const std::array<double, n>& x, const std::array<double, n>& y, double at) {
    if (at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
    return std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
}

}  // namespace

double contrast_threshold(double cycles_per_mrad, double luminance, double size_deg) {
    const double u = cycles_per_mrad * mrad_per_degree;
    const double finer = 1.0 + u / 3.0;
    const double a =
        540.0 * std::pow(1.0 + 0.7 / luminance, -0.2) / (1.0 + 12.0 / (size_deg * finer * finer));
    const double bu = 0.3 * std::pow(1.0 + 100.0 / luminance, 0.15) * u;
    // e^(bu) may be beyond a double's range: e^(−bu) √(1 + 0.06 e^(bu)) without it.
    const double down = std::exp(-0.5 * bu);
    return 1.0 / (a * u * down * std::sqrt(down * down + 0.06));
}

double pupil_diameter_mm(double luminance) {
    constexpr std::array<double, 8> power{-4, -3, -2, -1, 0, 1, 2, 3};
    constexpr std::array<double, 8> diameter{7.0, 6.2, 5.6, 4.9, 4.2, 3.6, 3.0, 2.5};
    return between(power, diameter, std::log10(luminance / foot_lambert));
}

double eye_mtf(double cycles_per_mrad, double pupil_mm) {
    constexpr std::array<double, 8> pupil{1.5, 2.0, 2.4, 3.0, 3.8, 4.9, 5.8, 6.6};
    constexpr std::array<double, 8> f0{36, 39, 35, 32, 25, 15, 11, 8};
    constexpr std::array<double, 8> i0{0.9, 0.8, 0.8, 0.77, 0.75, 0.72, 0.69, 0.66};
    const double f = std::abs(cycles_per_mrad);
    return std::exp(-std::pow(f / between(pupil, f0, pupil_mm), between(pupil, i0, pupil_mm)) -
                    0.375 * std::pow(f, 1.21) - 0.4441 * f * f);
}

double noise_channel(double noise, double signal) {
    const double octaves = std::log(noise / signal);
    return std::exp(-2.2 * octaves * octaves);
}

}  // namespace diurna
