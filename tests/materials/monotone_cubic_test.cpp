#include "materials/base/monotone_cubic.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace diurna;

namespace {

double curve(const std::vector<double>& place, const std::vector<double>& value,
             const std::vector<double>& slope, double x) {
    const HermiteWeights w = hermite_weights(place, x);
    return w.value_low * value[w.low] + w.slope_low * slope[w.low] +
           w.value_high * value[w.low + 1] + w.slope_high * slope[w.low + 1];
}

}  // namespace

TEST_CASE("a straight line stays straight over uneven places",
          "[materials][monotone][by_degenerate]") {
    const std::vector<double> place = {0.0, 0.1, 0.25, 0.5, 2.0, 7.0};
    std::vector<double> value;
    for (const double x : place) value.push_back(3.0 - 2.0 * x);
    const std::vector<double> slope = monotone_slopes(place, value);
    for (double x = 0.0; x <= 7.0; x += 0.037) {
        CHECK(curve(place, value, slope, x) == Approx(3.0 - 2.0 * x).margin(1e-12));
    }
    CHECK(curve(place, value, slope, -1.0) == 3.0);  // held beyond the ends
}

TEST_CASE("between values the curve neither overshoots nor breaks", "[materials][monotone]") {
    const auto seed = GENERATE(range(1u, 20u));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> step(0.01, 3.0), height(-5.0, 5.0);
    std::vector<double> place = {0.0}, value = {0.0};
    for (int i = 0; i < 12; ++i) {
        place.push_back(place.back() + step(random));
        value.push_back(random() % 4 == 0 ? value.back() : height(random));
    }
    const std::vector<double> slope = monotone_slopes(place, value);
    CAPTURE(seed);
    for (std::size_t i = 0; i + 1 < place.size(); ++i) {
        const double least = std::min(value[i], value[i + 1]);
        const double most = std::max(value[i], value[i + 1]);
        for (double t = 0.0; t <= 1.0; t += 0.05) {
            const double y = curve(place, value, slope, place[i] + t * (place[i + 1] - place[i]));
            CHECK(y >= least - 1e-12);
            CHECK(y <= most + 1e-12);
        }
        if (i == 0) continue;
        // One slope from both sides of a place.
        constexpr double h = 1e-6;
        const double here = curve(place, value, slope, place[i]);
        const double before = (here - curve(place, value, slope, place[i] - h)) / h;
        const double after = (curve(place, value, slope, place[i] + h) - here) / h;
        // Curvature is at most 6 times the change of value over the square of the step.
        const double step_here = std::min(place[i] - place[i - 1], place[i + 1] - place[i]);
        CHECK(before ==
              Approx(after).margin(1e-6 + 2.0 * h * 6.0 * 10.0 / (step_here * step_here)));
    }
}
