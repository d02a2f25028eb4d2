#include "render/instrument/mtf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace diurna {

using std::numbers::pi;

double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : std::sin(pi * x) / (pi * x); }

double diffraction_mtf(double nu) {
    nu = std::abs(nu);
    if (nu >= 1.0) return 0.0;
    return 2.0 / pi * (std::acos(nu) - nu * std::sqrt(1.0 - nu * nu));
}

double defocused_mtf(double nu, double waves) {
    nu = std::abs(nu);
    if (nu >= 1.0) return 0.0;
    if (waves == 0.0) return diffraction_mtf(nu);
    // x + ν = sin φ takes the root's end away: an even rule is then exact to high order.
    const double from = std::asin(nu), turns = 8.0 * pi * waves * nu;
    const int pieces = 64 + 8 * static_cast<int>(std::abs(turns));
    const double step = (0.5 * pi - from) / pieces;
    double sum = 0.0;
    for (int i = 0; i <= pieces; ++i) {  // Simpson
        const double phi = from + i * step, c = std::cos(phi);
        const double weight = i == 0 || i == pieces ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
        sum += weight * c * c * std::cos(turns * (std::sin(phi) - nu));
    }
    return 4.0 / pi * sum * step / 3.0;
}

double wavefront_mtf(double nu, double rms) {
    nu = std::abs(nu);
    if (nu >= 1.0) return 0.0;
    const double away = nu - 0.5, share = rms / 0.18;
    return std::max(0.0, 1.0 - share * share * (1.0 - 4.0 * away * away));
}

double diffusion_mtf(double frequency, double length) {
    const double x = 2.0 * pi * frequency * length;
    return 1.0 / (1.0 + x * x);
}

double jitter_mtf(double frequency, double rms) {
    const double x = pi * rms * frequency;
    return std::exp(-2.0 * x * x);
}

double turbulence_mtf(double cycles_per_rad, double wavelength, double fried_length) {
    const double x = std::abs(cycles_per_rad) * wavelength / fried_length;
    return std::exp(-3.44 * std::pow(x, 5.0 / 3.0));
}

double fried_length(double wavelength, double cn2, double range) {
    const double k = 2.0 * pi / wavelength;
    return std::pow(0.423 * 0.375 * k * k * cn2 * range, -0.6);
}

}  // namespace diurna
