#include "thermal/weather/sky_by_height.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "thermal/weather/light_by_height.hpp"

using namespace diurna;

namespace {

constexpr double low = 500.0;
const AirState alpine{.temperature = 283.0, .pressure = 95461.0, .vapour_pressure = 900.0};

SkyState at_height(double height, const Forcing& now, double elevation_deg, const ClearSky& clear) {
    const AirByHeight rule{.station = low};
    const SkyState sky = sky_state(SunPosition{180.0, elevation_deg, 1.0}, low, now, clear);
    return sky_at_height(sky, now, air_at_height(rule, now.air, height), rule, height, clear);
}

}  // namespace

TEST_CASE("clear longwave falls with height as measured in the Alps", "[thermal][sky][heights]") {
    // Marty, Philipona, Fröhlich & Ohmura 2002: 2.9 W/m² each 100 m, yearly means of stations from
    // 370 to 3580 m; the formula alone is good to some 10 %.
    Forcing now;
    now.air = alpine;
    now.cloud_fraction = 0.0;
    const double fall = at_height(low, now, -20.0, {}).longwave_down -
                        at_height(3500.0, now, -20.0, {}).longwave_down;
    CHECK(fall / 30.0 == Approx(2.9).margin(0.35));
    // Overcast is as warm as the air: σ T⁴, 6.5 K/km less.
    now.cloud_fraction = 1.0;
    CHECK(at_height(2500.0, now, -20.0, {}).longwave_down ==
          Approx(5.670374e-8 * std::pow(283.0 - 13.0, 4)).epsilon(1e-5));
}

TEST_CASE("the beam is as much stronger as there is less air above", "[thermal][sky][heights]") {
    // Bird & Hulstrom 1981 without aerosol, water and ozone: Rayleigh's scattering and the mixed
    // gases, by the air mass of Kasten 1966 times p / 1013 hPa.
    const ClearSky pure{
        .aerosol_380nm = 0.0, .aerosol_500nm = 0.0, .ozone_cm = 0.0, .precipitable_water_cm = 0.0};
    Forcing now;
    now.air = alpine;
    now.direct_normal = 700.0;
    now.diffuse = 60.0;
    const double elevation_deg = GENERATE(60.0, 20.0);
    const SkyState here = at_height(low, now, elevation_deg, pure);
    const SkyState there = at_height(3000.0, now, elevation_deg, pure);
    const double zenith = 90.0 - here.sun.elevation_deg;
    const double mass =
        1.0 / (std::cos(zenith * M_PI / 180.0) + 0.15 * std::pow(93.885 - zenith, -1.253));
    const auto beam = [&](double pascal) {
        const double m = mass * pascal / 101300.0;
        const double rayleigh =
            std::exp(-0.0903 * std::pow(m, 0.84) * (1.0 + m - std::pow(m, 1.01)));
        return rayleigh * std::exp(-0.0127 * std::pow(m, 0.26));
    };
    // Hydrostatic by hand: 2500 m of air of 274.9 K in the mean, a tenth of a per cent for vapour.
    const double above = 95461.0 * std::exp(-9.80665 * 2500.0 / (287.05 * 275.1));
    CHECK(here.direct_normal == 700.0);
    CHECK(there.direct_normal / 700.0 == Approx(beam(above) / beam(95461.0)).epsilon(1e-3));
    CHECK(there.direct_normal > 710.0);
    CHECK(there.diffuse_horizontal < 60.0);
    CHECK(there.albedo != there.albedo);
}

TEST_CASE("under thick cloud heights gain by what the clear sky as a whole gains",
          "[thermal][sky][heights]") {
    Forcing now;
    now.air = alpine;
    now.direct_normal = 0.0;
    now.diffuse = 120.0;
    now.cloud_fraction = 1.0;
    const SkyState there = at_height(3000.0, now, 50.0, {});
    CHECK(there.direct_normal == 0.0);
    CHECK(there.diffuse_horizontal > 120.0);
    CHECK(there.diffuse_horizontal < 1.15 * 120.0);
}

TEST_CASE("above a cloud's top the scene's air has the say, below it the station",
          "[thermal][sky][heights]") {
    Forcing now;
    now.air = alpine;
    now.direct_normal = 0.0;
    now.diffuse = 120.0;
    now.cloud_fraction = 1.0;
    LightByHeight air;
    air.cloud_top = 1500.0;
    air.instant = {parse_instant("2026-07-15T12:00:00Z"), parse_instant("2026-07-15T13:00:00Z")};
    air.height = {1500.5, 3000.0};
    air.ratio = {{1.0, 1.0, 1.0}, {1.1, 1.0, 1.0}, {1.0, 2.0, 1.0}, {1.1, 2.0, 1.2}};
    const AirByHeight rule{.station = low};
    SkyState sky = sky_state(SunPosition{180.0, 50.0, 1.0}, low, now, {});
    sky.by_height = &air;
    sky.when = parse_instant("2026-07-15T12:30:00Z");
    const auto at = [&](double height) {
        return sky_at_height(sky, now, air_at_height(rule, now.air, height), rule, height, {});
    };
    CHECK(at(1400.0).direct_normal == 0.0);
    CHECK(at(1400.0).longwave_down > 330.0);  // overcast
    const AirState high = air_at_height(rule, now.air, 3000.0);
    const Sunlight formula = clear_sunlight(sky.sun, high, 3000.0, {});
    CHECK(at(3000.0).direct_normal == Approx(1.1 * formula.direct_normal));
    CHECK(at(3000.0).diffuse_horizontal == Approx(1.5 * formula.diffuse_horizontal));
    CHECK(at(3000.0).longwave_down == Approx(1.1 * clear_longwave(high)));
}

TEST_CASE("a vacuum has the sun as in space and nothing else", "[thermal][sky]") {
    // Kopp & Lean 2011: 1361 W/m² at 1 au.
    const ClearSky vacuum = in_vacuum({});
    Forcing now;
    now.air = alpine;
    now.cloud_fraction = GENERATE(0.0, 1.0, not_measured);
    const SkyState sky = sky_state(SunPosition{180.0, 40.0, 1.0165}, low, now, vacuum);
    CHECK(sky.direct_normal == Approx(1361.0 / (1.0165 * 1.0165)).epsilon(1e-12));
    CHECK(sky.diffuse_horizontal == Approx(0.0).margin(1e-9));
    CHECK(sky.longwave_down == 0.0);
    CHECK(sky.tilted_longwave == 0.0);
    const SkyState night = sky_state(SunPosition{0.0, -30.0, 1.0}, low, now, vacuum);
    CHECK(night.direct_normal == 0.0);
    now.longwave_down = 12.0;
    CHECK(sky_state(SunPosition{0.0, -30.0, 1.0}, low, now, vacuum).longwave_down == 12.0);
}
