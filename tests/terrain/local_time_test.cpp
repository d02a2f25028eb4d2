#include "terrain/place/local_time.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

// Reda & Andreas 2004, NREL/TP-560-34302, table A5.1: observer's local hour angle 11.105900°.
TEST_CASE("solar time is that of NREL's SPA example", "[terrain][sun][by_comparison]") {
    const Site golden{39.742476, -105.1786, 1830.14};
    const Instant instant = parse_instant("2003-10-17T12:30:30-07:00");
    CHECK(solar_time_h(golden, instant) == Approx(12.0 + 11.1059 / 15.0).margin(1e-4));
    CHECK(format_solar_time(golden, instant) == "12:44");
}

TEST_CASE("an instant is printed in the local time of its place", "[terrain][instant]") {
    const Instant instant = parse_instant("2028-02-29T03:30:00Z");
    CHECK(format_local(instant, 0.0) == "2028-02-29T03:30:00+00:00");
    CHECK(format_local(instant, -3.5 * 3600.0) == "2028-02-29T00:00:00-03:30");
    CHECK(format_local(instant, -4.0 * 3600.0) == "2028-02-28T23:30:00-04:00");
    CHECK(format_local(instant, 5.75 * 3600.0) == "2028-02-29T09:15:00+05:45");
    CHECK(parse_instant(format_local(instant, 13.0 * 3600.0)) == instant);
    // Past midnight in solar time too: the sun of the Greenwich meridian at 0 h and at 12 h.
    const Site greenwich{51.5, 0.0, 0.0};
    for (const char* text : {"2026-03-20T23:59:00Z", "2026-03-21T00:30:00Z"}) {
        const double solar = solar_time_h(greenwich, parse_instant(text));
        CAPTURE(text, solar);
        CHECK((solar >= 0.0 && solar < 24.0));
        CHECK((solar > 23.5 || solar < 0.6));
    }
}
