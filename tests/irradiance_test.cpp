#include "thermal/irradiance.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/units.hpp"

using namespace diurna;

namespace {

const Site site{.latitude_deg = 40.0, .longitude_deg = -88.0, .height = 200.0};
const Instant noon = parse_instant("2020-06-21T18:00:00Z");
const Instant midnight = parse_instant("2020-06-21T06:00:00Z");

}  // namespace

TEST_CASE("Dilley and O'Brien's sky at three climates", "[thermal][irradiance][a12]") {
    // reference/thermal/analytic_cases.md, A12.
    CHECK(clear_longwave({288.15, 1e5, 1000.0}) == Approx(293.945).margin(0.01));
    CHECK(clear_longwave({303.15, 1e5, 800.0}) == Approx(339.734).margin(0.01));
    CHECK(clear_longwave({263.15, 1e5, 200.0}) == Approx(186.717).margin(0.01));
    // Overcast is black at air temperature, and cloud only adds.
    CHECK(cloudy_longwave({288.15, 1e5, 1000.0}, 1.0) == Approx(stefan_boltzmann * power4(288.15)));
    CHECK(cloudy_longwave({288.15, 1e5, 1000.0}, 0.0) == clear_longwave({288.15, 1e5, 1000.0}));
}

TEST_CASE("Bird's clear sky brightens with height and dims with water and dust",
          "[thermal][irradiance]") {
    const ClearSun high = bird_clear_sky(60.0, 1.0, 101325.0, 1.5);
    // Bird & Hulstrom's own range for a clear 30° zenith: direct 850 to 1000, diffuse 60 to 130.
    CHECK(high.direct_normal > 850.0);
    CHECK(high.direct_normal < 1000.0);
    CHECK(high.diffuse_horizontal > 60.0);
    CHECK(high.diffuse_horizontal < 130.0);
    CHECK(bird_clear_sky(60.0, 1.0, 70000.0, 1.5).direct_normal > high.direct_normal);
    CHECK(bird_clear_sky(60.0, 1.0, 101325.0, 4.0).direct_normal < high.direct_normal);
    ClearSky dusty;
    dusty.aerosol_380nm = 0.5;
    dusty.aerosol_500nm = 0.4;
    const ClearSun dust = bird_clear_sky(60.0, 1.0, 101325.0, 1.5, dusty);
    CHECK(dust.direct_normal < 0.85 * high.direct_normal);
    CHECK(dust.diffuse_horizontal > 1.5 * high.diffuse_horizontal);
    CHECK(bird_clear_sky(-1.0, 1.0, 101325.0, 1.5).direct_normal == 0.0);
    CHECK(bird_clear_sky(0.01, 1.0, 101325.0, 1.5).direct_normal < 40.0);
}

TEST_CASE("measured sun wins, and the horizontal facet gets exactly what was measured",
          "[thermal][irradiance]") {
    Forcing forcing;
    forcing.shortwave_down = 600.0;
    const double direct = GENERATE(not_measured, 500.0);
    const double diffuse = GENERATE(not_measured, 250.0);
    forcing.direct_normal = direct;
    forcing.diffuse = diffuse;
    for (const Instant when : {noon, midnight, parse_instant("2020-06-21T10:25:00Z")}) {
        const SkyState sky = sky_state(site, 200.0, when, forcing);
        CAPTURE(direct, diffuse, sky.sun.elevation_deg);
        CHECK(sky.global_horizontal() == Approx(600.0).epsilon(1e-12));
        const double flat = facet_sunlight(sky, sky.to_sun.z(), 1.0, 1.0);
        CHECK(flat == Approx(600.0).epsilon(1e-12));
    }
    const SkyState sky = sky_state(site, 200.0, midnight, forcing);
    CHECK(sky.direct_normal == 0.0);
}

TEST_CASE("a facet in shadow keeps only the even part of the sky it sees",
          "[thermal][irradiance]") {
    const SkyState sky = sky_state(site, 200.0, noon, Forcing{});
    const double even = sky.diffuse_horizontal * (1.0 - sky.anisotropy);
    CHECK(facet_sunlight(sky, 0.7, 0.0, 0.5) == Approx(0.5 * even));
    CHECK(facet_sunlight(sky, -0.3, 1.0, 0.5) == Approx(0.5 * even));
    const double facing = facet_sunlight(sky, 1.0, 1.0, 0.8);
    CHECK(facing == Approx(sky.direct_normal +
                           sky.diffuse_horizontal * sky.anisotropy / sky.to_sun.z() + 0.8 * even));
}

TEST_CASE("cloud is inferred from dimmed sun and held through the night", "[thermal][irradiance]") {
    Weather weather;
    for (int h = 0; h < 48; ++h) {
        const Instant when = later(midnight, 3600.0 * h);
        Forcing forcing;
        const SkyState clear = sky_state(site, 200.0, when, forcing);
        forcing.shortwave_down = 0.4 * clear.global_horizontal();
        weather.instant.push_back(when);
        weather.sample.push_back(forcing);
    }
    infer_cloud(weather, site, 200.0);
    for (const Forcing& forcing : weather.sample) {
        CHECK(forcing.cloud_fraction == Approx(0.6).margin(1e-9));
    }
    const SkyState night = sky_state(site, 200.0, midnight, weather.sample[0]);
    CHECK(night.longwave_down == Approx(cloudy_longwave(weather.sample[0].air, 0.6)));
}

TEST_CASE("up over down is the albedo where both are measured", "[thermal][irradiance]") {
    Forcing forcing;
    forcing.shortwave_down = 500.0;
    forcing.shortwave_up = 120.0;
    CHECK(sky_state(site, 200.0, noon, forcing).albedo == Approx(0.24));
    forcing.shortwave_down = 2.0;
    CHECK(std::isnan(sky_state(site, 200.0, noon, forcing).albedo));
}

TEST_CASE("Erbs's diffuse share is one under overcast and small in clear air",
          "[thermal][irradiance]") {
    CHECK(erbs_diffuse_share(0.0) == 1.0);
    CHECK(erbs_diffuse_share(0.22) == Approx(0.9802));
    CHECK(erbs_diffuse_share(0.5) == Approx(0.9511 - 0.0802 + 1.097 - 2.07975 + 0.771));
    CHECK(erbs_diffuse_share(0.9) == 0.165);
}
