#include "materials/air/air_by_height.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <tuple>

using namespace diurna;

namespace {

const AirState dry_standard{.temperature = 288.15, .pressure = 101325.0, .vapour_pressure = 0.0};

/// A morning's inversion of 5 K over 200 m.
std::shared_ptr<const Profile> inversion() {
    Profile p;
    p.name = "inversion";
    for (const auto& [km, hPa, kelvin, ppm] : {std::tuple{0.0, 1010.0, 280.0, 9000.0},
                                               {0.2, 986.0, 285.0, 8000.0},
                                               {1.0, 895.0, 281.0, 6000.0},
                                               {3.0, 698.0, 268.0, 3000.0},
                                               {12.0, 190.0, 215.0, 20.0}}) {
        AirSample air = air_at(afgl_profile("US76"), km);
        air.pressure_hPa = hPa;
        air.temperature = kelvin;
        air.mixing_ratio_ppm[0] = ppm;
        append_level(p, km, air);
    }
    return std::make_shared<const Profile>(std::move(p));
}

}  // namespace

TEST_CASE("pressure over the standard sea is ICAO's standard atmosphere",
          "[materials][air][by_comparison]") {
    // ICAO Doc 7488/3, table by geopotential height, which is height under one gravity.
    const AirByHeight rule{.station = 0.0};
    for (const auto& [height, kelvin, pascal] : {std::tuple{1000.0, 281.65, 89874.6},
                                                 {2000.0, 275.15, 79495.2},
                                                 {3000.0, 268.65, 70108.5},
                                                 {5000.0, 255.65, 54019.9}}) {
        const AirState air = air_at_height(rule, dry_standard, height);
        CHECK(air.temperature == Approx(kelvin).margin(1e-9));
        CHECK(air.pressure == Approx(pascal).epsilon(3e-5));
        CHECK(air.vapour_pressure == 0.0);
        // And from there down again.
        const AirState sea = air_at_height({.station = height}, air, 0.0);
        CHECK(sea.temperature == Approx(288.15).margin(1e-9));
        CHECK(sea.pressure == Approx(101325.0).epsilon(3e-5));
    }
}

TEST_CASE("vapour thins by Kunkel's coefficient and is never above saturation",
          "[materials][air][by_comparison]") {
    const AirByHeight rule{.station = 200.0};
    const AirState fair{.temperature = 290.0, .pressure = 99000.0, .vapour_pressure = 1000.0};
    CHECK(air_at_height(rule, fair, 1200.0).vapour_pressure ==
          Approx(1000.0 * std::exp(-0.379)).epsilon(1e-9));
    CHECK(air_at_height(rule, fair, 200.0).vapour_pressure == 1000.0);
    // Steam tables (IAPWS-95): 611.2 Pa at 0 °C, 657.1 at 1 °C; here it is 0.6 °C.
    const AirState damp{.temperature = 290.0, .pressure = 99000.0, .vapour_pressure = 1800.0};
    CHECK(air_at_height(rule, damp, 2700.0).vapour_pressure == Approx(638.6).epsilon(5e-3));
}

TEST_CASE("moist air is hydrostatic by its virtual temperature", "[materials][air]") {
    // Isothermal except for 1e-9 K/m, with vapour of one scale height: ∫ dz / Tv by Simpson's rule.
    const AirByHeight rule{.station = 0.0, .lapse = -1e-9};
    const AirState moist{.temperature = 305.0, .pressure = 1e5, .vapour_pressure = 3000.0};
    double ln_pressure = 0.0, pressure = 1e5;
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) * 2000.0 / steps;
        const double share = 3000.0 * std::exp(-0.379e-3 * z) / pressure;
        const double virtual_t = 305.0 / (1.0 - 0.37802 * share);
        ln_pressure -= 9.80665 / (287.05 * virtual_t) * 2000.0 / steps;
        pressure = 1e5 * std::exp(ln_pressure);
    }
    CHECK(air_at_height(rule, moist, 2000.0).pressure == Approx(pressure).epsilon(5e-5));
}

TEST_CASE("a lapse of nothing is the station's air at all heights",
          "[materials][air][by_degenerate]") {
    const AirByHeight rule{.station = 300.0, .lapse = 0.0};
    const AirState air{.temperature = 301.0, .pressure = 97000.0, .vapour_pressure = 1234.0};
    for (const double height : {0.0, 300.0, 3000.0}) {
        const AirState there = air_at_height(rule, air, height);
        CHECK(there.temperature == air.temperature);
        CHECK(there.pressure == air.pressure);
        CHECK(there.vapour_pressure == air.vapour_pressure);
    }
}

TEST_CASE("an inversion of a profile is that of the ground at its heights", "[materials][air]") {
    const AirByHeight rule{.station = 100.0, .profile = inversion()};
    const AirState cold{.temperature = 279.0, .pressure = 99800.0, .vapour_pressure = 700.0};
    // The profile has 282.5 K at the station; 3.5 K colder there fade over 1.5 km.
    CHECK(air_at_height(rule, cold, 0.0).temperature == Approx(280.0 - 3.5));
    CHECK(air_at_height(rule, cold, 200.0).temperature == Approx(285.0 - 3.5 * 1400.0 / 1500.0));
    CHECK(air_at_height(rule, cold, 1600.0).temperature == Approx(281.0 - 0.6 * 6.5));
    CHECK(air_at_height(rule, cold, 3000.0).temperature == Approx(268.0));
    const AirState high = air_at_height(rule, cold, 3000.0);
    CHECK(high.vapour_pressure == Approx(3000e-6 * high.pressure));
    // Hydrostatic from the station: layers' mean temperatures by hand, Tv 0.3 % above T.
    CHECK(high.pressure ==
          Approx(99800.0 * std::exp(-9.80665 / 287.05 * 2900.0 / 277.6)).epsilon(3e-3));
}

TEST_CASE("lines of sight and facets have the same air at every height", "[materials][air]") {
    for (const AirByHeight& rule :
         {AirByHeight{.station = 320.0}, AirByHeight{.station = 320.0, .lapse = -9.8e-3},
          AirByHeight{.station = 320.0, .profile = inversion()},
          AirByHeight{.station = 2600.0, .lapse = 4e-3}}) {
        const AirState weather{.temperature = 302.0,
                               .pressure = rule.station > 1000.0 ? 75000.0 : 97200.0,
                               .vapour_pressure = 1900.0};
        const Profile column = profile_over(afgl_profile("MLS"), rule, weather, 180.0, 2710.0);
        check(column);
        for (double height = 180.0; height <= 2710.0; height += 17.0) {
            const AirState ground = air_at_height(rule, weather, height);
            const AirSample line = air_at(column, height * 1e-3);
            CAPTURE(height);
            CHECK(line.temperature == Approx(ground.temperature).margin(0.01));
            CHECK(line.pressure_hPa * 100.0 == Approx(ground.pressure).epsilon(1e-4));
            // Between two levels saturation may set in, the more sharply the colder it is below.
            CHECK(line.vapour_pressure_hPa() * 100.0 ==
                  Approx(ground.vapour_pressure).epsilon(rule.lapse > 0.0 ? 1e-2 : 5e-3));
        }
        // The free air above is left alone.
        const AirSample free = air_at(afgl_profile("MLS"), 4.3), same = air_at(column, 4.3);
        CHECK(same.temperature == Approx(free.temperature));
        CHECK(same.pressure_hPa == Approx(free.pressure_hPa));
    }
}
