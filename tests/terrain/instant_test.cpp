#include "terrain/place/instant.hpp"

#include <catch2/catch.hpp>

#include "materials/base/error.hpp"

using namespace diurna;

TEST_CASE("an instant with an offset is the same moment as in UTC", "[terrain][instant]") {
    const Instant spa = parse_instant("2003-10-17T12:30:30-07:00");
    CHECK(spa == parse_instant("2003-10-17T19:30:30Z"));
    CHECK(spa == parse_instant("2003-10-18T01:15:30+05:45"));
    CHECK(parse_instant("1970-01-01T00:00Z").time_since_epoch().count() == 0);
    // 2000-03-01 is 11017 days after 1970-01-01 (the leap day of 2000 included).
    CHECK(parse_instant("2000-03-01T00:00:00Z").time_since_epoch() == std::chrono::days(11017));
}

TEST_CASE("an instant's text says how far its clock is ahead of UTC", "[terrain][instant]") {
    CHECK(utc_offset_of("2003-10-17T12:30:30-07:00") == -25200.0);
    CHECK(utc_offset_of("2003-10-18T01:15+05:45") == 20700.0);
    CHECK(utc_offset_of("2003-10-17T19:30:30Z") == 0.0);
}

TEST_CASE("decimals of a second are exact to the millisecond", "[terrain][instant]") {
    CHECK(format_instant(parse_instant("2003-10-17T19:30:30.25Z")) == "2003-10-17T19:30:30.250Z");
    CHECK(format_instant(parse_instant("2003-10-17T19:30:30.9996Z")) == "2003-10-17T19:30:31Z");
}

TEST_CASE("what is written is read again as the same moment", "[terrain][instant]") {
    const auto text = GENERATE("2003-10-17T19:30:30Z", "1969-12-31T23:59:59.999Z",
                               "2000-02-29T00:00:00Z", "2099-12-31T12:00:00Z");
    CHECK(format_instant(parse_instant(text)) == text);
    CHECK(format_instant(parse_instant("2003-10-17T19:30:30Z"), true) == "20031017T193030Z");
}

TEST_CASE("anything that is not a full ISO 8601 moment is refused in one line",
          "[terrain][instant][stress]") {
    const auto text =
        GENERATE("", "2003", "2003-10-17", "2003-10-17T19:30:30", "2003-10-17 19:30:30Z",
                 "2003-02-29T00:00:00Z", "2003-13-01T00:00:00Z", "2003-10-17T24:00:00Z",
                 "2003-10-17T12:60:00Z", "2003-10-17T12:00:60Z", "2003-10-17T12:00:00.Z",
                 "2003-10-17T12:00:00+07", "2003-10-17T12:00:00+0700", "2003-10-17T12:00:00+16:00",
                 "2003-10-17T12:00:00Z ", "nan", "2003-10-1xT12:00:00Z");
    CAPTURE(text);
    try {
        parse_instant(text, "scene.toml:3:9: time.start");
        FAIL("accepted");
    } catch (const InputError& error) {
        const std::string line = error.what();
        CHECK(line.starts_with("scene.toml:3:9: time.start: found '"));
        CHECK(line.find('\n') == std::string::npos);
    }
}

TEST_CASE("later and seconds_between are each other's inverse", "[terrain][instant]") {
    const Instant noon = parse_instant("2003-10-17T12:00:00Z");
    CHECK(seconds_between(noon, later(noon, 0.125)) == 0.125);
    CHECK(seconds_between(noon, later(noon, -86400.0)) == -86400.0);
}
