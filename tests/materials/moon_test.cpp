#include "materials/atmosphere/moonlight.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/band.hpp"

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
    CHECK_THROWS_AS(moon_over_sun(0.5, {.phase_deg = 200.0}), InputError);
    CHECK_THROWS_AS(moon_over_sun(0.5, {.distance_km = 1.0}), InputError);
}

TEST_CASE("scattered moonlight is sunlight from the same place times the moon's share",
          "[materials][moon]") {
    // Scattering is linear in what comes in; each node carries the share of its own wavelength.
    const BandModel air{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const std::vector<double> node = {0.36, 0.55, 1.6, 2.9, 3.2};
    const MoonLight half{.phase_deg = 90.0, .distance_km = 370e3, .sun_distance_au = 0.99};
    const SunField moon(air, {.zenith_deg = 40.0, .moon = half}, node);
    const SunField sun(air, {.zenith_deg = 40.0}, node);
    const SunFlux by_moon = moon.flux(0.1), by_sun = sun.flux(0.1);
    const std::vector<double> moon_sky = moon.sky(0.1, 60.0, 20.0), sky = sun.sky(0.1, 60.0, 20.0);
    for (std::size_t n = 0; n < node.size(); ++n) {
        CAPTURE(node[n]);
        const double share = moon_over_sun(node[n], half);
        CHECK(by_moon.direct[n] == Approx(share * by_sun.direct[n]));
        CHECK(by_moon.down[n] == Approx(share * by_sun.down[n]));
        CHECK(moon_sky[n] == Approx(share * sky[n]));
    }
    CHECK(moon_over_sun(3.2, half) == 0.0);
}

TEST_CASE("under the full moon the ground has a tenth to a third of a lux", "[materials][moon]") {
    // Kyba et al. 2017: 0.05 to 0.2 lux at usual heights of the full moon, at most 0.3 in clear
    // air. Luminous efficacy of sunlight at the ground, 105 lm/W of all its power (Littlefair
    // 1985), of which 0.38 to 0.75 µm is about half: 205 lm for each watt of that band.
    const BandModel air{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const Band band = flat_band("visible", 0.38, 0.75, bin_edges_um());
    for (const double zenith_deg : {20.0, 60.0}) {
        CAPTURE(zenith_deg);
        const SunField moon(air, {.zenith_deg = zenith_deg, .moon = MoonLight{}}, band.node_um);
        const SunField sun(air, {.zenith_deg = zenith_deg}, band.node_um);
        const auto horizontal = [&](const SunField& field) {
            const SunFlux flux = field.flux(0.0);
            return band_sum_nodes(band, flux.direct) * std::cos(radians(zenith_deg)) +
                   band_sum_nodes(band, flux.down);
        };
        const double lux = 205.0 * horizontal(moon);
        CHECK(lux > 0.1);
        CHECK(lux < 0.3);
        // Magnitudes -12.73 and -26.75 are 14.02 apart: one to 404 000.
        CHECK(horizontal(sun) / horizontal(moon) == Approx(404e3).epsilon(0.06));
    }
}
