#include "thermal/weather/sky_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

// Quadratic B-splines over the clearness ζ: knots and, column by column, F11 F12 F13 F21 F22 F23.
constexpr std::array<double, 13> knot = {0.0,   0.0,   0.0,   0.061, 0.187, 0.333, 0.487,
                                         0.643, 0.778, 0.839, 1.0,   1.0,   1.0};
constexpr std::array<std::array<double, 6>, 10> at_knots = {
    {{-0.053, 0.529, -0.028, -0.071, 0.061, -0.019},
     {-0.008, 0.588, -0.062, -0.060, 0.072, -0.022},
     {0.131, 0.770, -0.167, -0.026, 0.106, -0.032},
     {0.328, 0.471, -0.216, 0.069, -0.105, -0.028},
     {0.557, 0.241, -0.300, 0.086, -0.085, -0.012},
     {0.861, -0.323, -0.355, 0.240, -0.467, -0.008},
     {1.212, -1.239, -0.444, 0.305, -0.797, 0.047},
     {1.099, -1.847, -0.365, 0.275, -1.132, 0.124},
     {0.544, 0.157, -0.213, 0.118, -1.455, 0.292},
     {0.544, 0.157, -0.213, 0.118, -1.455, 0.292}}};

/// The six splines at ζ, 0 to 1, by de Boor's recursion.
std::array<double, 6> splines(double zeta) {
    std::size_t k = 2;
    while (k < 9 && zeta >= knot[k + 1]) ++k;
    const auto part = [&](std::size_t i, std::size_t width) {
        return (zeta - knot[i]) / (knot[i + width] - knot[i]);
    };
    std::array<double, 6> f;
    for (std::size_t c = 0; c < f.size(); ++c) {
        const double low = std::lerp(at_knots[k - 2][c], at_knots[k - 1][c], part(k - 1, 2));
        const double high = std::lerp(at_knots[k - 1][c], at_knots[k][c], part(k, 2));
        f[c] = std::lerp(low, high, part(k, 1));
    }
    return f;
}

/// The horizon's brightness: c₀ + 44.3 z − 18.3 z² − c₁ ln z, largest at z = 0, below 0.06 of what
/// it is at 2° from 15° up. What level ground and a wall take of 1, z, z², −ln z in all are
/// 1, ⅔, ½, ½ and ½, 2/3π, ⅛, ¼ + ½ ln 2; the first comes to 0, the second to 1.
struct HorizonShape {
    double constant, by_z = 44.3, by_square = -18.3, by_log;

    HorizonShape() {
        const double level = -2.0 / 3.0 * by_z - 0.5 * by_square;
        const double wall = 1.0 - 2.0 / (3.0 * std::numbers::pi) * by_z - 0.125 * by_square;
        by_log = (wall - 0.5 * level) / (0.5 * std::numbers::ln2);
        constant = level - 0.5 * by_log;
    }
};

}  // namespace

DiffuseSplit perez_split(double direct_normal, double diffuse, double zenith_deg, double top) {
    if (!(diffuse > 0.0) || zenith_deg >= 90.0) return {};
    const double zenith = radians(zenith_deg);
    // Kasten & Young 1989.
    const double mass =
        1.0 / (std::cos(zenith) + 0.50572 * std::pow(96.07995 - zenith_deg, -1.6364));
    const double brightness = diffuse * mass / top;
    const double bare = direct_normal / (diffuse + direct_normal);
    const double zeta = bare / (1.0 + 1.041 * zenith * zenith * zenith * (1.0 - bare));
    const auto f = splines(std::clamp(zeta, 0.0, 1.0));
    return {.circumsolar = std::clamp(f[0] + f[1] * brightness + f[2] * zenith, 0.0, 0.9),
            .horizon = f[3] + f[4] * brightness + f[5] * zenith};
}

double horizon_view(const SkyVector& sky) {
    static const HorizonShape shape;
    return shape.constant * double{sky[0]} + shape.by_z * double{sky[1]} +
           shape.by_square * double{sky[2]} + shape.by_log * double{sky[3]};
}

}  // namespace diurna
