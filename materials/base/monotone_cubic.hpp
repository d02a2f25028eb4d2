#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "materials/base/interval.hpp"

namespace diurna {

/// The slope at an end of the curve below: a parabola's, if it does not turn.
inline double monotone_end_slope(double near_step, double far_step, double near_secant,
                                 double far_secant) {
    const double s = ((2.0 * near_step + far_step) * near_secant - near_step * far_secant) /
                     (near_step + far_step);
    if (s * near_secant <= 0.0) return 0.0;
    return near_secant * far_secant <= 0.0 && std::abs(s) > 3.0 * std::abs(near_secant)
               ? 3.0 * near_secant
               : s;
}

/// Slopes of the curve through values at ascending places that is monotone wherever they are:
/// weighted harmonic means of the secants (Fritsch & Butland 1984, in Brodlie's form for uneven
/// spacing), zero at extremes; at the ends those of a parabola, unless it changes sign.
///
/// The Hermite curve with these slopes has a continuous first derivative, so tables interpolated
/// with it have no kinks. Needs two places or more.
inline std::vector<double> monotone_slopes(std::span<const double> place,
                                           std::span<const double> value) {
    const std::size_t n = place.size();
    std::vector<double> slope(n, 0.0), secant(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        secant[i] = (value[i + 1] - value[i]) / (place[i + 1] - place[i]);
    }
    if (n == 2) return {secant[0], secant[0]};
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = secant[i - 1], after = secant[i];
        if (before * after <= 0.0) continue;
        const double below = place[i] - place[i - 1], above = place[i + 1] - place[i];
        const double a = 2.0 * above + below, b = above + 2.0 * below;
        slope[i] = (a + b) / (a / before + b / after);
    }
    slope[0] = monotone_end_slope(place[1] - place[0], place[2] - place[1], secant[0], secant[1]);
    slope[n - 1] = monotone_end_slope(place[n - 1] - place[n - 2], place[n - 2] - place[n - 3],
                                      secant[n - 2], secant[n - 3]);
    return slope;
}

/// Weights of the values and slopes at both ends of the interval that holds a place, clamped to
/// the grid.
struct HermiteWeights {
    std::size_t low = 0;  // and low + 1
    double t = 0.0;       // fraction of the interval
    double value_low = 1.0, slope_low = 0.0, value_high = 0.0, slope_high = 0.0;
};
inline HermiteWeights hermite_weights(std::span<const double> place, double x) {
    x = std::clamp(x, place.front(), place.back());
    HermiteWeights w;
    w.low = interval_of(place, x);
    const double step = place[w.low + 1] - place[w.low];
    const double t = w.t = (x - place[w.low]) / step, u = 1.0 - t;
    w.value_low = u * u * (1.0 + 2.0 * t);
    w.slope_low = u * u * t * step;
    w.value_high = t * t * (3.0 - 2.0 * t);
    w.slope_high = -t * t * u * step;
    return w;
}

}  // namespace diurna
