#include "terrain/place/sun.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace diurna;

// Reda & Andreas, "Solar position algorithm for solar radiation applications", NREL/TP-560-34302
// (2008), worked example of appendix A.5.
TEST_CASE("the sun is where NREL's SPA example has it", "[terrain][sun][by_comparison]") {
    const Site golden{39.742476, -105.1786, 1830.14};
    const Instant instant = parse_instant("2003-10-17T12:30:30-07:00");
    const SunPosition sun = sun_position(golden, instant, 820.0, 11.0);
    CHECK(90.0 - sun.elevation_deg == Approx(50.11162).margin(0.0005));
    CHECK(sun.azimuth_deg == Approx(194.34024).margin(0.0005));
    CHECK(sun.distance_au == Approx(0.9965422974).margin(5e-5));  // geocentric there
}

// The same report, table A4: sun-earth distance and declination follow from the date alone.
TEST_CASE("the sun passes overhead where latitude is its declination", "[terrain][sun]") {
    // At the June solstice of 2020 (21:44 UT on the 20th) the declination is the obliquity of date,
    // 23.43663° (Astronomical Almanac 2020, C5: 23° 26′ 11.9″ mean obliquity, nutation +1.5″).
    const Instant solstice = parse_instant("2020-06-20T21:44:00Z");
    double best = 0.0;
    for (double longitude_deg = -180.0; longitude_deg < 180.0; longitude_deg += 0.05) {
        best = std::max(best, sun_position({23.4366, longitude_deg, 0.0}, solstice).elevation_deg);
    }
    CHECK(best > 89.96);
}

TEST_CASE("the earth's distance is least in January and greatest in July", "[terrain][sun]") {
    // Perihelion 2020-01-05 07:48 UT 0.9832436 au, aphelion 2020-07-04 11:35 UT 1.0166943 au
    // (USNO); seen from the surface up to one earth radius, 4.26e-5 au, nearer or farther.
    const Site site{0.0, 0.0, 0.0};
    const auto at = [&](const char* text) {
        return sun_position(site, parse_instant(text)).distance_au;
    };
    CHECK(at("2020-01-05T07:48:00Z") == Approx(0.9832436).margin(4.3e-5));
    CHECK(at("2020-07-04T11:35:00Z") == Approx(1.0166943).margin(4.3e-5));
}

TEST_CASE("the sun's direction and its angles say the same", "[terrain][sun]") {
    const SunPosition sun{200.0, 30.0, 1.0};
    const Eigen::Vector3d d = sun_direction(sun);
    CHECK(d.z() == Approx(0.5));
    CHECK(std::atan2(d.x(), d.y()) * 180.0 / M_PI + 360.0 == Approx(200.0));
}

TEST_CASE("refraction lifts the sun by half a degree at the horizon and nothing overhead",
          "[terrain][sun]") {
    // Walk through a sunset: Sæmundsson's formula gives 0.48° at 0° apparent-less elevation for
    // 1010 hPa and 10 °C, and zero below -0.83°.
    const Site site{40.0, 0.0, 0.0};
    for (int minute = 0; minute < 1440; ++minute) {
        const Instant instant = later(parse_instant("2021-03-20T00:00:00Z"), 60.0 * minute);
        const double bare = sun_position(site, instant).elevation_deg;
        const double lift = sun_position(site, instant, 1010.0, 10.0).elevation_deg - bare;
        CAPTURE(minute, bare, lift);
        if (bare < -0.8334) CHECK(lift == 0.0);
        if (std::abs(bare) < 0.05) CHECK(lift == Approx(0.48).margin(0.015));
        if (bare > 45.0)
            CHECK(lift == Approx(1.02 / 60.0 / std::tan(bare * M_PI / 180)).epsilon(0.01));
        CHECK(lift >= 0.0);
    }
}

TEST_CASE("poles, date line and far years give finite angles",
          "[terrain][sun][stress][by_extreme]") {
    const auto site = GENERATE(values<Site>(
        {{90.0, 0.0, 0.0}, {-90.0, 0.0, 2800.0}, {0.0, 180.0, 0.0}, {0.0, -180.0, 8848.0}}));
    const auto text = GENERATE("1900-01-01T00:00:00Z", "2016-12-31T23:59:59.999Z",
                               "2026-07-15T12:00:00Z", "2100-12-31T00:00:00Z");
    const SunPosition sun = sun_position(site, parse_instant(text), 1013.25, 15.0);
    CHECK(sun.azimuth_deg >= 0.0);
    CHECK(sun.azimuth_deg < 360.0);
    CHECK(std::abs(sun.elevation_deg) <= 90.0);
    CHECK(sun.distance_au == Approx(1.0).margin(0.018));
}
