#include "thermal/weather/wind_share.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("wind falls towards the ground by the logarithm of height", "[thermal][wind]") {
    // ln(z / 0.03) / ln(10 / 0.03), by hand.
    CHECK(wind_at_height(10.0, 10.0) == 1.0);
    CHECK(wind_at_height(2.0, 10.0) == Approx(0.7229).epsilon(1e-3));
    CHECK(wind_at_height(1.5, 10.0) == Approx(0.6734).epsilon(1e-3));
    CHECK(wind_at_height(30.0, 10.0) == Approx(1.1891).epsilon(1e-3));
    CHECK(wind_at_height(0.0, 10.0) == wind_at_height(0.5, 10.0));
}

TEST_CASE("the lee of a wall is that of Perera", "[thermal][wind][by_comparison]") {
    // h = 10 m, x = 100 m, z = 10 m: K = 0.32 / ln(333.3) = 0.05509, η = 0.5509^−0.47 = 1.3234,
    // 9.75 · 0.1 · 1.3234 · exp(−0.67 · 1.5224) = 0.4653; at 2 m: η = 0.2647, 0.2355.
    CHECK(lee_deficit(100.0, 10.0, 10.0) == Approx(0.4653).epsilon(2e-3));
    CHECK(lee_deficit(100.0, 10.0, 2.0) == Approx(0.2355).epsilon(2e-3));
    CHECK(lee_deficit(100.0, 10.0, 0.0) == lee_deficit(100.0, 10.0, 2.0));
    // Less the farther, and never more than two thirds; nothing over its top or far behind.
    double before = 1.0;
    for (double x = 1.0; x < 300.0; x += 7.0) {
        const double less = lee_deficit(x, 10.0, 2.0);
        CHECK(less <= before);
        CHECK(less <= 2.0 / 3.0);
        CHECK(less > 0.0);
        before = less;
    }
    CHECK(lee_deficit(301.0, 10.0, 2.0) == 0.0);
    CHECK(lee_deficit(20.0, 10.0, 40.0) < 1e-3);
    CHECK(lee_deficit(1.0, 0.1, 2.0) == 0.0);
}
