#include "scenes/studies/elementary_effects.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>

using namespace diurna;

namespace {

template <class Function>
std::vector<ElementaryEffect> effects_of(const MorrisDesign& design, const Function& function) {
    std::vector<double> result;
    for (const std::vector<double>& point : design.point) result.push_back(function(point));
    return elementary_effects(design, result);
}

}  // namespace

TEST_CASE("each input of a trajectory changes once, by the step, within the range",
          "[scenes][sensitivity]") {
    const int levels = GENERATE(2, 4, 6);
    const MorrisDesign design = morris_design(7, 20, levels, 3);
    CHECK(design.step == Approx(levels / (2.0 * (levels - 1))));
    REQUIRE(design.point.size() == 20 * 8);
    for (std::size_t t = 0; t < 20; ++t) {
        std::vector<int> changes(7);
        for (std::size_t k = 0; k < 7; ++k) {
            const std::size_t at = design.changed[7 * t + k];
            ++changes[at];
            for (std::size_t i = 0; i < 7; ++i) {
                const double way = design.point[8 * t + k + 1][i] - design.point[8 * t + k][i];
                CHECK(std::abs(way) == Approx(i == at ? design.step : 0.0));
                CHECK(design.point[8 * t + k][i] >= 0.0);
                CHECK(design.point[8 * t + k][i] <= 1.0);
            }
        }
        CHECK(changes == std::vector<int>(7, 1));
    }
}

TEST_CASE("a longer design begins with a shorter one; another seed is another design",
          "[scenes][sensitivity]") {
    const MorrisDesign shorter = morris_design(5, 4, 4, 11), longer = morris_design(5, 9, 4, 11);
    for (std::size_t i = 0; i < shorter.point.size(); ++i) {
        CHECK(shorter.point[i] == longer.point[i]);
    }
    CHECK(morris_design(5, 4, 4, 12).point != shorter.point);
}

TEST_CASE("a linear function's effects are its coefficients",
          "[scenes][sensitivity][by_variation]") {
    const auto found = effects_of(morris_design(3, 6, 4, 1), [](const std::vector<double>& x) {
        return 5.0 + 2.0 * x[0] - 3.0 * x[1];
    });
    const double coefficient[] = {2.0, -3.0, 0.0};
    for (int i = 0; i < 3; ++i) {
        CHECK(found[i].mean == Approx(coefficient[i]).margin(1e-13));
        CHECK(found[i].mean_size == Approx(std::abs(coefficient[i])).margin(1e-13));
        CHECK(found[i].deviation == Approx(0.0).margin(1e-13));
        CHECK(found[i].size_error == Approx(0.0).margin(1e-13));
        CHECK(found[i].count == 6);
    }
}

TEST_CASE("the effect of x1 in x1 x2 is x2: mean 1/2, deviation that of the levels",
          "[scenes][sensitivity][by_variation]") {
    // Of 0, 1/3, 2/3, 1: variance 5/36. 4000 draws: 5 standard errors of the mean are 0.029.
    const auto found = effects_of(morris_design(2, 4000, 4, 5),
                                  [](const std::vector<double>& x) { return x[0] * x[1]; });
    for (const ElementaryEffect& one : found) {
        CHECK(one.mean == Approx(0.5).margin(0.029));
        CHECK(one.deviation == Approx(std::sqrt(5.0) / 6.0).margin(0.02));
        CHECK(one.size_error == Approx(one.deviation / std::sqrt(4000.0)));
    }
}

TEST_CASE("Sobol's g function: effects of both signs, whose mean hides what mu* shows",
          "[scenes][sensitivity][by_variation][by_comparison]") {
    // g = prod (|4 x - 2| + a) / (1 + a), a as in Campolongo et al. 2007. On four levels |4 x - 2|
    // is 2, 2/3, 2/3, 2, and every step of 2/3 goes from one to the other: worked out by hand,
    // mu* = 2 / (1 + a_i) prod_{j != i} (4/3 + a_j) / (1 + a_j), mu = 0.
    const std::vector<double> a{0.001, 89.9, 5.54, 42.10, 0.78, 1.26};
    const auto found =
        effects_of(morris_design(a.size(), 4000, 4, 9), [&](const std::vector<double>& x) {
            double g = 1.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                g *= (std::abs(4.0 * x[i] - 2.0) + a[i]) / (1.0 + a[i]);
            }
            return g;
        });
    for (std::size_t i = 0; i < a.size(); ++i) {
        double expected = 2.0 / (1.0 + a[i]);
        for (std::size_t j = 0; j < a.size(); ++j) {
            if (j != i) expected *= (4.0 / 3.0 + a[j]) / (1.0 + a[j]);
        }
        CAPTURE(i, expected);
        CHECK(std::abs(found[i].mean_size - expected) < 4.5 * found[i].size_error);
        CHECK(std::abs(found[i].mean) < 4.5 * found[i].deviation / std::sqrt(4000.0));
        CHECK(found[i].size_error < 0.02 * expected);
    }
}

TEST_CASE("a point without a result is skipped and counted", "[scenes][sensitivity]") {
    const MorrisDesign design = morris_design(2, 3, 4, 1);
    std::vector<double> result;
    for (const std::vector<double>& x : design.point) result.push_back(4.0 * x[0]);
    result.front() = std::numeric_limits<double>::quiet_NaN();
    const auto found = elementary_effects(design, result);
    const std::size_t first = design.changed.front();
    CHECK(found[first].count == 2);
    CHECK(found[1 - first].count == 3);
    CHECK(found[0].mean == Approx(4.0));
}
