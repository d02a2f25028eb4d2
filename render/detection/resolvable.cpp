#include "render/detection/resolvable.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace diurna {

namespace {

double finest_along(double difference, const Imager& imager,
                    const std::function<double(double)>& mtf) {
    const auto resolved = [&](double f) {
        return resolvable_difference(f, mtf(f), imager) <= difference;
    };
    double low = 0.0, high = imager.finest();
    if (resolved(high)) return high;
    for (int i = 0; i < 60; ++i) {
        const double f = 0.5 * (low + high);
        (resolved(f) ? low : high) = f;
    }
    return low;
}

}  // namespace

double resolvable_difference(double cycles_per_mrad, double mtf, const Imager& imager) {
    constexpr double pi = std::numbers::pi;
    if (!(mtf > 0.0)) return std::numeric_limits<double>::infinity();
    // (T45) of docs/theory.md
    return bar_threshold * pi * pi / (4.0 * std::sqrt(7.0)) * imager.netd * cycles_per_mrad *
           imager.pixel / (mtf * std::sqrt(eye_seconds * imager.frame_rate));
}

double resolved_frequency(double difference, const Imager& imager) {
    return std::sqrt(finest_along(difference, imager, imager.mtf_right) *
                     finest_along(difference, imager, imager.mtf_down));
}

double resolved_cycles(double difference, double length, double range, const Imager& imager) {
    return resolved_frequency(difference, imager) * 1000.0 * length / range;
}

}  // namespace diurna
