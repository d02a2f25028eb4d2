#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/support/thermal_cases.hpp"
#include "thermal/column/nonlinear_column.hpp"

using namespace diurna;
using namespace manufactured;

TEST_CASE("halving the cells quarters the error", "[thermal][manufactured][a11][by_variation]") {
    std::vector<double> truth;
    for (int i = 1; i <= 8; ++i) truth.push_back(exact(0.0, 21600.0 * i / 8));
    const double coarse = apart(solve(80, 768), truth), fine = apart(solve(160, 768), truth);
    const double order = std::log2(coarse / fine);
    WARN(fmt::format("A11 in space: {:.2e}, {:.2e} K, order {:.3f}", coarse, fine, order));
    CHECK(order >= 1.8);
    CHECK(fine < 0.05);
}

TEST_CASE("halving the steps quarters the error", "[thermal][manufactured][a11][by_variation]") {
    const auto reference = solve(80, 2048);
    const double coarse = apart(solve(80, 16), reference), fine = apart(solve(80, 32), reference);
    const double order = std::log2(coarse / fine);
    WARN(fmt::format("A11 in time: {:.2e}, {:.2e} K, order {:.3f}", coarse, fine, order));
    CHECK(order >= 1.8);
}
