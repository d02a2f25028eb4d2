#include "thermal/weather/weather_warnings.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/refused_weather.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"
#include "thermal/weather/sun_lag.hpp"

using namespace diurna;

// Implausible values of weather files: measured days as they are, and the same with
// their times moved by a known number of hours.

namespace {

struct MeasuredDays {
    Site site;
    Weather weather;
    Instant begin, end;
    double known_to = 900.0;  // [s]
};

Weather moved_by(Weather weather, double seconds) {
    for (Instant& when : weather.instant) when = later(when, seconds);
    return weather;
}

std::vector<MeasuredDays> measured_days() {
    std::vector<MeasuredDays> all;
    const auto add = [&](const measured::Series& s, const char* from, const char* to) {
        all.push_back({s.site, s.weather, parse_instant(from), parse_instant(to)});
    };
    if (const auto f = shared_data("data/thermal/surfrad_alamosa_20160101")) {
        add(measured::alamosa(*f), "2016-01-01T00:00:00Z", "2016-01-02T00:00:00Z");
    }
    if (const auto f = shared_data("data/thermal/surfrad_bondville_19950510")) {
        add(measured::bondville_1995(*f), "1995-05-10T00:00:00Z", "1995-05-11T00:00:00Z");
        // One day under thick cloud, darker before noon than after: 20 minutes late.
        all.back().known_to = 1800.0;
    }
    if (const auto f = shared_data("data/thermal/bondville_1998")) {
        const measured::Series s = measured::bondville_1998(*f);
        add(s, "1998-01-10T00:00:00-06:00", "1998-01-11T00:00:00-06:00");
        add(s, "1998-04-10T00:00:00-06:00", "1998-04-13T00:00:00-06:00");
        add(s, "1998-06-20T00:00:00-06:00", "1998-06-21T00:00:00-06:00");
    }
    if (const auto f = shared_data("data/thermal/woodhouse_mesa_2022")) {
        const measured::Series s = measured::woodhouse(*f);
        add(s, "2022-09-15T17:00:00-07:00", "2022-09-17T16:00:00-07:00");
    }
    if (const auto f = shared_data("data/thermal/weissfluhjoch_mst96")) {
        const measured::Series s = measured::weissfluhjoch(*f, 0.0);
        add(s, "1995-11-10T00:00:00+01:00", "1995-11-12T00:00:00+01:00");
    }
    return all;
}

/// A clear week by the sun's sine alone: 1000 W/m² times it.
Weather clear_week(const Site& site, double air_temperature = 288.15) {
    Weather weather;
    for (int i = 0; i <= 7 * 144; ++i) {
        const Instant when = later(parse_instant("2024-06-01T00:00:00Z"), 600.0 * i);
        Forcing f;
        f.air = {.temperature = air_temperature, .pressure = 95000.0, .vapour_pressure = 1000.0};
        f.wind_speed = 2.0;
        f.shortwave_down =
            1000.0 * std::max(0.0, std::sin(radians(sun_position(site, when).elevation_deg)));
        weather.instant.push_back(when);
        weather.sample.push_back(f);
    }
    return weather;
}

std::vector<Mistake> warnings_of(const Weather& weather, const Site& site) {
    return weather_warnings(weather, site, weather.instant.front(), weather.instant.back(),
                            "w.csv");
}

bool reported(const std::vector<Mistake>& warnings, const std::string& part) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const Mistake& m) { return m.line().find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("measured days raise no warning", "[thermal][weather][warnings]") {
    for (const MeasuredDays& days : measured_days()) {
        CAPTURE(days.site.latitude_deg, format_instant(days.begin));
        Weather weather = days.weather;
        weather.height = days.site.height;
        const auto warnings =
            weather_warnings(weather, days.site, days.begin, days.end, "weather.csv");
        for (const Mistake& warning : warnings) UNSCOPED_INFO(warning.line());
        CHECK(warnings.empty());
    }
}

TEST_CASE("shifts of measured days are found to a quarter of an hour",
          "[thermal][weather][warnings]") {
    const double hours = GENERATE(-7.0, -4.0, -1.0, 2.0, 5.5, 9.0);
    for (const MeasuredDays& days : measured_days()) {
        CAPTURE(days.site.latitude_deg, format_instant(days.begin), hours);
        const Weather moved = moved_by(days.weather, -3600.0 * hours);
        const Instant middle = later(days.begin, 0.5 * seconds_between(days.begin, days.end));
        const auto lag =
            sun_lag(moved, days.site, later(middle, -5 * 86400.0), later(middle, 5 * 86400.0));
        REQUIRE(lag);
        CHECK(std::abs(lag->seconds - 3600.0 * hours) <= days.known_to);
        const auto warnings =
            weather_warnings(moved, days.site, days.begin, days.end, "weather.csv");
        CHECK(reported(warnings, "times seem to be"));
        CHECK(reported(warnings, hours > 0.0 ? " early" : " late"));
    }
}

TEST_CASE("a course of the sun has no lag, and one over another longitude its hours",
          "[thermal][weather][warnings]") {
    // 15 degrees of longitude are an hour; the equation of time is the same at both.
    const Site here{.latitude_deg = 48.0, .longitude_deg = 10.0},
        west{.latitude_deg = 48.0, .longitude_deg = -65.0};
    const Weather weather = clear_week(here);
    const Instant begin = weather.instant.front(), end = weather.instant.back();
    const auto none = sun_lag(weather, here, begin, end), five = sun_lag(weather, west, begin, end);
    REQUIRE((none && five));
    CHECK(std::abs(none->seconds) < 150.0);  // half the 5 minutes from shift to shift
    CHECK(five->seconds == Approx(5 * 3600.0).margin(120.0));
    CHECK(warnings_of(weather, here).empty());
    CHECK(reported(warnings_of(weather, west), "-05:00"));
}

TEST_CASE("units that are not a column's are refused with the one they look like",
          "[thermal][weather][warnings]") {
    const ScratchFolder folder("weather_units");
    const auto says = [&](const std::string& column, double value) {
        return diurna::testing::message_of(
            folder.path / "w.csv", "time,air_temperature_K," + column +
                                       "\n2024-06-01T00:00:00Z,288.15," + std::to_string(value) +
                                       "\n");
    };
    using diurna::testing::has;
    CHECK(has(diurna::testing::message_of(folder.path / "w.csv",
                                          "time,air_temperature_K\n2024-06-01T00:00:00Z,21.5\n"),
              "declare it in [weather.columns] as \"air_temperature degC\""));
    CHECK(has(says("relative_humidity", 65.0), "\"relative_humidity %\""));
    CHECK(has(says("cloud_fraction", 7.0), "\"cloud_fraction okta\""));
    CHECK(has(says("shortwave_down_W_m2", 1800000.0), "\"shortwave_down J/m2\""));
    // And the reported remedy is right.
    write_text(folder.path / "w.csv", "time,air_temperature_K\n2024-06-01T00:00:00Z,21.5\n");
    const WeatherOptions options{
        .columns = {declared_column("air_temperature_K", "air_temperature degC", "here")}};
    CHECK(read_weather(folder.path / "w.csv", options).sample.front().air.temperature ==
          Approx(294.65));
}

TEST_CASE("values that cannot occur at the ground raise warnings", "[thermal][weather][warnings]") {
    const Site site{.latitude_deg = 48.0, .longitude_deg = 10.0};
    CHECK(reported(warnings_of(clear_week(site, 115.0), site), "air_temperature_K"));
    CHECK(reported(warnings_of(clear_week(site, 345.0), site), "air_temperature_K"));
    CHECK(warnings_of(clear_week(site, 329.0), site).empty());  // Furnace Creek had 329.9 K
    CHECK(warnings_of(clear_week(site, 184.0), site).empty());  // Vostok 183.9 K

    Weather dark = clear_week(site);
    for (Forcing& f : dark.sample) f.shortwave_down = 0.0;
    CHECK(reported(warnings_of(dark, site), "no sunlight was measured"));

    Weather night = clear_week(site);
    night.sample[144].shortwave_down = 538.0;  // midnight of UTC, the sun 20 degrees down
    CHECK(reported(warnings_of(night, site),
                   "538 W/m2 of sunlight measured at 2024-06-02T00:00:00Z"));

    // Kilojoules of half an hour for watts: 1.8 times as much, more than 1.5 S s^1.2 + 100 about
    // noon.
    Weather bright = clear_week(site);
    for (Forcing& f : bright.sample) f.shortwave_down *= 1.95;
    CHECK(reported(warnings_of(bright, site), "shortwave_down_W_m2"));

    // 460 W/m² are more than a black body of 288 K and 25 W/m² send (415.9), 140 less than 0.4 of
    // it (156.4).
    for (const auto& [longwave, fine] :
         {std::pair{460.0, false}, {415.0, true}, {157.0, true}, {140.0, false}}) {
        Weather sky = clear_week(site);
        for (Forcing& f : sky.sample) f.longwave_down = longwave;
        CAPTURE(longwave);
        CHECK(warnings_of(sky, site).empty() == fine);
    }
}

TEST_CASE("a mean pressure of another height raises a warning with that height",
          "[thermal][weather]") {
    // ICAO's standard atmosphere has 834.3 hPa at 1600 m, 968.4 at 381 m.
    Weather weather;
    weather.height = 381.0;
    const Instant begin = parse_instant("2026-07-15T00:00:00Z");
    for (int h = 0; h <= 24; ++h) {
        Forcing f;
        f.air = {.temperature = 290.0, .pressure = 83600.0, .vapour_pressure = 900.0};
        weather.instant.push_back(later(begin, 3600.0 * h));
        weather.sample.push_back(f);
    }
    const Site site{.latitude_deg = 34.0, .longitude_deg = -118.0, .height = 381.0};
    const auto lines = [&] {
        std::string all;
        for (const Mistake& warning :
             weather_warnings(weather, site, begin, later(begin, 86400.0), "weather.file")) {
            all += warning.line() + "\n";
        }
        return all;
    };
    CHECK(lines().find("836 hPa is that of about 1600 m above the sea, but the station counts as "
                       "at 381 m") != std::string::npos);
    weather.height = 1600.0;
    CHECK(lines().empty());
    // A deep low at the sea, 955 hPa on the mean of a day, is weather.
    weather.height = 0.0;
    for (Forcing& f : weather.sample) f.air.pressure = 95500.0;
    CHECK(lines().empty());
}
