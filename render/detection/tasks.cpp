#include "render/detection/tasks.hpp"

#include <cmath>

namespace diurna {

namespace {

struct Exponent {
    double a, b;
};
constexpr Exponent johnson{2.7, 0.7}, ttp{1.51, 0.24};

double probability_at(double x, const Exponent& e) {
    if (!(x > 0.0)) return 0.0;
    // (T46) of docs/theory.md
    // x^E / (1 + x^E) without an infinity over another
    return 1.0 / (1.0 + std::exp(-(e.a + e.b * x) * std::log(x)));
}

double ratio_at(double probability, const Exponent& e) {
    double low = 0.0, high = 1.0;
    while (probability_at(high, e) < probability && high < 1e6) high *= 2.0;
    for (int i = 0; i < 100; ++i) {
        const double x = 0.5 * (low + high);
        (probability_at(x, e) < probability ? low : high) = x;
    }
    return 0.5 * (low + high);
}

}  // namespace

double johnson_probability(double cycles, double cycles_at_half) {
    return probability_at(cycles / cycles_at_half, johnson);
}

double ttp_probability(double value, double value_at_half) {
    return probability_at(value / value_at_half, ttp);
}

double johnson_ratio(double probability) { return ratio_at(probability, johnson); }
double ttp_ratio(double probability) { return ratio_at(probability, ttp); }

}  // namespace diurna
