#include "materials/base/quadrature.hpp"

#include <array>
#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("Gauss and Legendre's nodes and weights are the published ones",
          "[materials][quadrature][by_comparison]") {
    // Abramowitz & Stegun, table 25.4, n = 4 and 8, here from the middle outwards.
    constexpr std::array<double, 2> node4 = {0.339981043584856, 0.861136311594053};
    constexpr std::array<double, 2> weight4 = {0.652145154862546, 0.347854845137454};
    constexpr std::array<double, 4> node8 = {0.183434642495650, 0.525532409916329,
                                             0.796666477413627, 0.960289856497536};
    constexpr std::array<double, 4> weight8 = {0.362683783378362, 0.313706645877887,
                                               0.222381034453374, 0.101228536290376};
    const auto compare = [](const auto& node, const auto& weight) {
        const std::size_t half = node.size();
        const Quadrature rule = gauss_legendre(static_cast<int>(2 * half));
        for (std::size_t i = 0; i < half; ++i) {
            CHECK(rule.node[half + i] == Approx(node[i]).margin(6e-16));
            CHECK(rule.node[half - 1 - i] == Approx(-node[i]).margin(6e-16));
            CHECK(rule.weight[half + i] == Approx(weight[i]).margin(1e-15));
            CHECK(rule.weight[half - 1 - i] == Approx(weight[i]).margin(1e-15));
        }
    };
    compare(node4, weight4);
    compare(node8, weight8);
}

TEST_CASE("n points integrate polynomials of degree 2n - 1 between any ends",
          "[materials][quadrature]") {
    const int points = GENERATE(1, 2, 3, 4, 8, 16, 40);
    const double from = 0.2, to = 1.3;
    const Quadrature rule = gauss_legendre(points, from, to);
    const int degree = 2 * points - 1;
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        sum += rule.weight[i] * std::pow(rule.node[i], degree);
    }
    CAPTURE(points);
    const double exact = (std::pow(to, degree + 1) - std::pow(from, degree + 1)) / (degree + 1);
    CHECK(sum == Approx(exact).epsilon(1e-13));
}
