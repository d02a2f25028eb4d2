#include "materials/air/moist_air.hpp"

#include <catch2/catch.hpp>

#include "materials/air/saturation.hpp"

using namespace diurna;

TEST_CASE("saturation vapour pressure follows the steam tables",
          "[materials][air][by_comparison]") {
    // IAPWS-95 [Pa]; Murray's formula is within 0.3 %.
    CHECK(saturation_vapour_pressure(273.16) == Approx(611.66).epsilon(0.003));
    CHECK(saturation_vapour_pressure(283.15) == Approx(1228.2).epsilon(0.003));
    CHECK(saturation_vapour_pressure(293.15) == Approx(2339.3).epsilon(0.003));
    CHECK(saturation_vapour_pressure(303.15) == Approx(4246.9).epsilon(0.003));
    CHECK(saturation_vapour_pressure(313.15) == Approx(7384.9).epsilon(0.003));
}

TEST_CASE("the slope of saturation is its derivative", "[materials][air][by_variation]") {
    const double t = GENERATE(235.0, 273.15, 300.0, 340.0);
    const double d = 0.001;
    const double difference =
        (saturation_vapour_pressure(t + d) - saturation_vapour_pressure(t - d)) / (2.0 * d);
    double slope = 0.0;
    CHECK(saturation_over_water(t, slope) == Approx(saturation_vapour_pressure(t)).epsilon(1e-14));
    CHECK(slope == Approx(difference).epsilon(1e-7));
}

TEST_CASE("air is saturated at its dew point", "[materials][air]") {
    const double t = GENERATE(230.0, 273.16, 295.0, 330.0);
    CHECK(dew_point(saturation_vapour_pressure(t)) == Approx(t).epsilon(1e-13));
}

TEST_CASE("dew point and saturation stay finite at the ends",
          "[materials][air][stress][by_extreme]") {
    CHECK(dew_point(0.0) > 0.0);
    CHECK(dew_point(0.0) < 200.0);
    CHECK(saturation_vapour_pressure(0.0) >= 0.0);
    CHECK(saturation_vapour_pressure(35.86) < 1e-10);
}

TEST_CASE("moist air is lighter than dry", "[materials][air]") {
    // US Standard Atmosphere 1976 at sea level: 1.2250 kg/m3.
    CHECK(air_density({.temperature = 288.15, .pressure = 101325, .vapour_pressure = 0}) ==
          Approx(1.2250).epsilon(1e-4));
    // Sum of two ideal gases, R = 8.31446 J/mol K, M = 28.9647 and 18.0153 g/mol.
    const double expected = (99325.0 * 0.0289647 + 2000.0 * 0.0180153) / (8.31446 * 300.0);
    CHECK(air_density({.temperature = 300, .pressure = 101325, .vapour_pressure = 2000}) ==
          Approx(expected).epsilon(1e-4));
}

TEST_CASE("latent heat follows the steam tables", "[materials][air][by_comparison]") {
    CHECK(latent_heat_of_vaporisation(273.15) == Approx(2.5009e6).epsilon(0.002));
    CHECK(latent_heat_of_vaporisation(293.15) == Approx(2.4535e6).epsilon(0.002));
    CHECK(latent_heat_of_vaporisation(313.15) == Approx(2.4060e6).epsilon(0.002));
}

TEST_CASE("pressure follows the standard atmosphere", "[materials][air]") {
    // US Standard Atmosphere 1976, geopotential heights [m], pressures [Pa].
    CHECK(standard_pressure(0) == Approx(101325).epsilon(1e-6));
    CHECK(standard_pressure(1000) == Approx(89874.6).epsilon(1e-5));
    CHECK(standard_pressure(5000) == Approx(54019.9).epsilon(1e-5));
    CHECK(standard_pressure(11000) == Approx(22632.1).epsilon(1e-5));
    CHECK(standard_pressure(15000) == Approx(12044.6).epsilon(1e-4));
}
