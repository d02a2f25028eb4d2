#include <catch2/catch.hpp>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

// Clocks in weather files: changes to and from summer time, leap days, midnights of UTC and place.

using namespace diurna;

namespace {

/// A CSV of our columns in which each row's temperature counts up by a kelvin from 280.
Weather read(const std::string& stamps, AskedSpan asked = {}) {
    const ScratchFolder folder("clock");
    const auto file = folder.path / "clock.csv";
    std::string text = "time,air_temperature_K\n", stamp;
    int kelvin = 280;
    for (const char c : stamps + " ") {
        if (c != ' ') {
            stamp += c;
            continue;
        }
        text += stamp + "," + std::to_string(kelvin++) + "\n";
        stamp.clear();
    }
    write_text(file, text);
    return read_weather(file, {.interval = Stamp::instant, .asked = asked});
}

double kelvin_at(const Weather& weather, const char* when) {
    return weather.at(parse_instant(when)).air.temperature;
}

}  // namespace

TEST_CASE("hours that a clock shows twice are two hours, a skipped one does not exist",
          "[thermal][weather_file][clock]") {
    const Weather back = read(
        "2026-11-01T00:30:00-04:00 2026-11-01T01:30:00-04:00 2026-11-01T01:30:00-05:00 "
        "2026-11-01T02:30:00-05:00");
    REQUIRE(back.instant.size() == 4);
    CHECK(kelvin_at(back, "2026-11-01T05:30:00Z") == 281.0);
    CHECK(kelvin_at(back, "2026-11-01T06:00:00Z") == 281.5);
    CHECK(kelvin_at(back, "2026-11-01T06:30:00Z") == 282.0);
    const Weather forward = read(
        "2026-03-08T00:00:00-05:00 2026-03-08T01:00:00-05:00 2026-03-08T03:00:00-04:00 "
        "2026-03-08T04:00:00-04:00",
        {parse_instant("2026-03-08T05:00:00Z"), parse_instant("2026-03-08T08:00:00Z")});
    CHECK(forward.instant.size() == 4);
    CHECK(forward.note.find("filled") == std::string::npos);
    CHECK(kelvin_at(forward, "2026-03-08T07:00:00Z") == 282.0);
    // The same hour twice with one offset goes back in time.
    CHECK_THROWS_WITH(
        read("2026-11-01T00:30:00-04:00 2026-11-01T01:30:00-04:00 "
             "2026-11-01T01:30:00-04:00"),
        Catch::Contains("clock.csv:4") && Catch::Contains("is not later than the previous row"));
}

TEST_CASE("midnights and leap days are instants like others", "[thermal][weather_file][clock]") {
    const Weather leap =
        read("2028-02-28T12:00:00Z 2028-02-29T00:00:00Z 2028-02-29T12:00:00Z 2028-03-01T00:00:00Z");
    CHECK(kelvin_at(leap, "2028-02-29T06:00:00Z") == 281.5);
    CHECK(seconds_between(leap.instant.front(), leap.instant.back()) == 36.0 * 3600.0);
    CHECK_THROWS_WITH(read("2026-02-28T12:00:00Z 2026-02-29T00:00:00Z"),
                      Catch::Contains("does not exist"));
    // Rows of one day on clocks of two: midnight of the place, and of Greenwich six hours later.
    const Weather year = read(
        "2026-12-31T23:00:00-06:00 2027-01-01T00:00:00-06:00 2027-01-01T07:00:00Z "
        "2027-01-01T02:00:00-06:00");
    REQUIRE(year.instant.size() == 4);
    CHECK(kelvin_at(year, "2027-01-01T06:30:00Z") == 281.5);
}
