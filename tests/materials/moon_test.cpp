#include "materials/atmosphere/moon.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"

using namespace diurna;

TEST_CASE("the full moon gives a third of a lux", "[materials][moon]") {
    // Kyba et al. 2017 (doi:10.1093/astrogeo/atx025): at most 0.3 lux at the zenith, above the air
    // 0.32 at mean distance; half moons a ninth to a twelfth of that.
    const double sun_lux = 133.1e3;  // of the solar constant's spectrum
    const double full = sun_lux * moon_over_sun(0.55, {});
    CHECK(full == Approx(0.32).epsilon(0.05));
    const double half = sun_lux * moon_over_sun(0.55, {.phase_deg = 90.0});
    CHECK(full / half > 9.0);
    CHECK(full / half < 12.0);
    CHECK(moon_over_sun(0.55, {.phase_deg = 180.0}) < 1e-3 * moon_over_sun(0.55, {}));
}

TEST_CASE("moonlight is redder than sunlight and obeys the square of distance",
          "[materials][moon]") {
    CHECK(moon_over_sun(1.6, {}) / moon_over_sun(0.45, {}) == Approx(2.1).epsilon(0.15));
    CHECK(moon_over_sun(0.6, {.distance_km = 360e3}) / moon_over_sun(0.6, {.distance_km = 400e3}) ==
          Approx(std::pow(400.0 / 360.0, 2)));
    const BandModel air{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const std::vector<double> node = {0.55, 1.6};
    const auto moon = lunar_at_nodes(air, 0.0, 40.0, {}, node);
    const auto sun = solar_at_nodes(air, 0.0, 40.0, 1.0, node);
    CHECK(moon[1] / sun[1] == Approx(moon_over_sun(1.6, {})));
    CHECK_THROWS_AS(moon_over_sun(0.5, {.phase_deg = 200.0}), InputError);
    CHECK_THROWS_AS(moon_over_sun(0.5, {.distance_km = 1.0}), InputError);
}
