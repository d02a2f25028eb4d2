#include "thermal/weather/sun_course.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/sun_path.hpp"
#include "tests/support/hourly_sun.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/shared_data.hpp"
#include "thermal/weather/sky_series.hpp"

using namespace diurna;
using namespace diurna::testing;

// Bounds against minutes averaged to hours and put back: 40 W/m² rms on walls, sums to
// 1 %, no peak above 1.05 of the truth's.
TEST_CASE("hourly means of a clear day give its minutes back", "[thermal][weather][hourly]") {
    const double latitude = GENERATE(0.0, 36.0, 60.0, 70.0);
    const std::string date = GENERATE("2026-03-21T00:00:00Z", "2026-06-21T00:00:00Z");
    const Minutes truth = clear_day(latitude, date);
    struct Case {
        const char* name;
        Given given;
        double rms;  // [W m⁻²] that is reached, a fifth more
    };
    for (const Case& c : {Case{"global", {true, false, false}, 36.0},
                          Case{"global and direct", {true, true, false}, 3.0},
                          Case{"global and diffuse", {true, false, true}, 3.0},
                          Case{"all", {true, true, true}, 3.0}}) {
        const Minutes got = put_back(truth, means(truth, 60, c.given));
        for (const double azimuth : {90.0, 180.0, 270.0}) {
            const Figures f = compare(truth, got, azimuth);
            CAPTURE(latitude, date, c.name, azimuth, f.rms, f.largest, f.sum);
            CHECK(f.rms <= c.rms);
            CHECK(f.largest <= 1.05);
            CHECK(std::abs(f.sum) <= 1e-3);
        }
    }
}

TEST_CASE("each interval keeps its sum, those with sunrise and sunset too",
          "[thermal][weather][hourly][by_trace]") {
    const Minutes truth = clear_day(48.0, "2026-04-11T00:00:00Z");
    const int minutes = GENERATE(10, 30, 60, 180);
    // Direct light beside the global one changes its course within the interval, not its sum.
    const bool direct = GENERATE(false, true), diffuse = GENERATE(false, true);
    if (diffuse && !direct) return;
    CAPTURE(direct, diffuse);
    // Clouds of its own every interval, so that neighbours differ by a factor of up to ten.
    Weather weather = means(truth, minutes, {true, direct, diffuse});
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const double clouds = 0.1 + 0.9 * double((i * 7919) % 10) / 9.0;
        Forcing& forcing = weather.sample[i];
        for (double* flux : {&forcing.shortwave_down, &forcing.direct_normal, &forcing.diffuse}) {
            *flux *= clouds;
        }
    }
    const SkySeries sky(weather, truth.site, 0.0, {}, truth.start, later(truth.start, 86400.0));
    SunPath path(truth.site);
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        double sum = 0.0, least = 1e9;
        const int parts = 40 * minutes;
        for (int k = 0; k < parts; ++k) {
            const Instant when =
                later(weather.instant[i], 60.0 * minutes * ((k + 0.5) / parts - 0.5));
            const SkyState now = sky.at(when, path.at(when));
            sum += now.global_horizontal() / parts;
            least = std::min({least, now.direct_normal, now.diffuse_horizontal});
        }
        CAPTURE(minutes, i, weather.sample[i].shortwave_down);
        CHECK(sum == Approx(weather.sample[i].shortwave_down).epsilon(1e-3).margin(0.02));
        CHECK(least >= 0.0);
    }
}

TEST_CASE("light does not jump where intervals meet", "[thermal][weather][hourly]") {
    const Minutes truth = clear_day(36.0, "2026-06-21T00:00:00Z");
    Weather weather = means(truth, 60, {true, false, false});
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        weather.sample[i].shortwave_down *= i % 2 == 0 ? 1.0 : 0.6;
    }
    const SkySeries sky(weather, truth.site, 0.0, {}, truth.start, later(truth.start, 86400.0));
    SunPath path(truth.site);
    for (int hour = 7; hour < 18; ++hour) {
        const Instant edge = later(truth.start, 3600.0 * hour);
        const SkyState before = sky.at(later(edge, -0.01), path.at(later(edge, -0.01)));
        const SkyState after = sky.at(later(edge, 0.01), path.at(later(edge, 0.01)));
        CAPTURE(hour);
        CHECK(std::abs(after.direct_normal - before.direct_normal) < 0.1);
        CHECK(std::abs(after.diffuse_horizontal - before.diffuse_horizontal) < 0.1);
    }
}

TEST_CASE("measured minutes come back from their hours",
          "[thermal][weather][hourly][measured][by_history]") {
    const auto folder = shared_data("data/thermal/surfrad_alamosa_20160101");
    if (!folder) return;
    const measured::Series series = measured::alamosa(*folder);
    Minutes truth{.site = series.site,
                  .start = parse_instant("2016-01-01T00:00:00Z"),
                  .direct = {},
                  .diffuse = {},
                  .global = {}};
    for (std::size_t i = 0; i < 1440; ++i) {
        const Forcing f = series.weather.at(truth.at(i));
        truth.direct.push_back(f.direct_normal);
        truth.diffuse.push_back(f.diffuse);
        truth.global.push_back(f.shortwave_down);
    }
    truth.air = series.weather.at(truth.at(720)).air;
    const bool all = GENERATE(true, false);
    const Minutes got = put_back(truth, means(truth, 60, {true, all, all}));
    for (const double azimuth : {90.0, 180.0, 270.0}) {
        const Figures f = compare(truth, got, azimuth);
        CAPTURE(all, azimuth, f.rms, f.largest, f.sum);
        CHECK(f.rms <= 40.0);
        CHECK(f.largest <= 1.05);
        CHECK(std::abs(f.sum) <= 0.01);
    }
}

TEST_CASE("measured light while the sun is down is skylight, and reported",
          "[thermal][weather][hourly]") {
    const Minutes day = clear_day(60.0, "2026-01-10T00:00:00Z");
    Weather weather = means(day, 60, {true, false, false});
    for (Forcing& forcing : weather.sample) forcing.shortwave_down = 300.0;
    const SkySeries sky(weather, day.site, 0.0, {}, day.start, later(day.start, 86400.0));
    SunPath path(day.site);
    const SkyState night = sky.at(day.start, path.at(day.start));
    CHECK(night.diffuse_horizontal == Approx(300.0));
    CHECK(night.direct_normal == 0.0);
    CHECK(sky.sunlight().in_the_dark > 10);
    CHECK(sky.sunlight().brightest_dark == Approx(300.0));
}

TEST_CASE("Engerer2 divides a clear and an overcast hour",
          "[thermal][weather][separation][by_comparison]") {
    // By hand from the table of Bright & Engerer 2019, hourly: Threlkeld & Jordan's clear sky on
    // day 172 at a zenith of 20°, A = 1086.5, k = 0.2071, C = 0.1328, top 1318: clearness 0.7549.
    const SeparationCase clear{.clearness = 0.75,
                               .minutes = 60.0,
                               .zenith_deg = 20.0,
                               .solar_hour = 12.0,
                               .day_of_year = 172.0,
                               .top = 1318.0};
    CHECK(engerer2_diffuse_share(clear) == Approx(0.19690).margin(2e-5));
    SeparationCase overcast = clear;
    overcast.clearness = 0.15;
    CHECK(engerer2_diffuse_share(overcast) > 0.98);
    overcast.minutes = 1.0;
    CHECK(engerer2_diffuse_share(overcast) > 0.98);
}
