#include "terrain/place/sun_passages.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "terrain/place/sun.hpp"

using namespace diurna;

namespace {

double seconds_off(Instant found, const char* expected) {
    return seconds_between(parse_instant(expected), found);
}

}  // namespace

// Reda & Andreas, NREL/TP-560-34302 (2008), worked example of appendix A.5: transit at 18:46:04.97
// UT, sunrise at 13:12:43.46, sunset at 00:20:19.19 (the centre 0.8333 degrees below the horizon,
// seen from the earth's middle: 2.4 thousandths of a degree, a second at most); at 12:30:30 local
// time azimuth 194.340241 and elevation 39.872046 degrees without refraction.
TEST_CASE("the sun passes when NREL's SPA example has it",
          "[terrain][sun][by_events][by_comparison]") {
    const Site golden{39.742476, -105.1786, 1830.14};
    const Instant from = parse_instant("2003-10-17T00:00:00-07:00");
    const Instant to = parse_instant("2003-10-18T00:00:00-07:00");
    const auto south = sun_at_azimuth(golden, from, to, 180.0);
    REQUIRE(south.size() == 1);
    CHECK(std::abs(seconds_off(south[0], "2003-10-17T18:46:05Z")) <= 1.0);
    // (Its day is that of UT: its sunset is the one that ends the 16th on the clock there.)
    const auto horizon =
        sun_at_elevation(golden, parse_instant("2003-10-17T00:00:00Z"),
                         parse_instant("2003-10-18T00:00:00Z"), -0.8333, DayHalf::both);
    REQUIRE(horizon.size() == 2);
    CHECK(std::abs(seconds_off(horizon[0], "2003-10-17T00:20:19Z")) <= 2.0);
    CHECK(std::abs(seconds_off(horizon[1], "2003-10-17T13:12:43Z")) <= 2.0);
    const auto turned = sun_at_azimuth(golden, from, to, 194.340241);
    REQUIRE(turned.size() == 1);
    CHECK(std::abs(seconds_off(turned[0], "2003-10-17T12:30:30-07:00")) <= 1.0);
    const auto sinking = sun_at_elevation(golden, from, to, 39.872046, DayHalf::afternoon);
    REQUIRE(sinking.size() == 1);
    CHECK(std::abs(seconds_off(sinking[0], "2003-10-17T12:30:30-07:00")) <= 1.0);
    const auto climbing = sun_at_elevation(golden, from, to, 39.872046, DayHalf::morning);
    REQUIRE(climbing.size() == 1);
    CHECK(climbing[0] < south[0]);
}

// Meeus, "Astronomical Algorithms", example 28.a: the equation of time on 1992 October 13 at 0h TD
// is +13 min 42.6 s. At 180 degrees of longitude apparent noon is that much before 0h UT; in that
// quarter of an hour and the 59 s from UT to TD it changes by a tenth of a second.
TEST_CASE("noon is the equation of time before the mean one", "[terrain][sun][by_events]") {
    for (const double latitude_deg : {50.0, -50.0}) {
        const auto noon =
            sun_at_azimuth({latitude_deg, 180.0, 0.0}, parse_instant("1992-10-12T12:00:00Z"),
                           parse_instant("1992-10-13T12:00:00Z"), latitude_deg > 0.0 ? 180.0 : 0.0);
        REQUIRE(noon.size() == 1);
        CHECK(std::abs(seconds_off(noon[0], "1992-10-12T23:46:17.4Z")) <= 1.0);
    }
}

TEST_CASE("a sun that just reaches a height passes it twice, or not", "[terrain][sun]") {
    const Site site{36.0, 0.0, 0.0};
    const Instant from = parse_instant("2026-03-20T00:00:00Z");
    const Instant to = parse_instant("2026-03-21T00:00:00Z");
    const auto noon = sun_at_azimuth(site, from, to, 180.0);
    REQUIRE(noon.size() == 1);
    const double top = sun_position(site, noon[0]).elevation_deg;
    // Near its summit it sinks by half of cos(latitude) of the hour angle squared at an equinox
    // over the sine of its distance from the zenith: 0.001 degrees are 20.4 s on either side.
    const auto both = sun_at_elevation(site, from, to, top - 0.001, DayHalf::both);
    REQUIRE(both.size() == 2);
    const double hour_angle = std::sqrt(2.0 * 0.001 * M_PI / 180.0 * std::tan(36.0 * M_PI / 180.0));
    CHECK(seconds_between(both[0], both[1]) ==
          Approx(2.0 * hour_angle * 43200.0 / M_PI).margin(4.0));
    CHECK(sun_at_elevation(site, from, to, top + 0.001, DayHalf::both).empty());
    // Between the tropics the sun may pass an azimuth twice a morning, away from the pole and back:
    // at 10 degrees it rises at acos(sin 23.44 / cos 10) = 66.2 and is at most at
    // asin(cos 23.44 / cos 10) = 68.7.
    const Site tropic{10.0, 0.0, 0.0};
    CHECK(sun_at_azimuth(tropic, parse_instant("2026-06-21T00:00:00Z"),
                         parse_instant("2026-06-22T00:00:00Z"), 67.5)
              .size() == 2);
    CHECK(sun_at_azimuth(tropic, parse_instant("2026-06-21T00:00:00Z"),
                         parse_instant("2026-06-22T00:00:00Z"), 180.0)
              .empty());
}
