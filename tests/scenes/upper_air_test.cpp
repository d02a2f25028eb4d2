#include "scenes/job/world/upper_air.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "materials/air/seasonal_profile.hpp"

using namespace diurna;

namespace {

/// Air that warms by `per_day` [K] from 270 K and swings by 5 K a day, hourly for twelve days.
Weather warming(double per_day, double longwave = not_measured) {
    Weather weather;
    for (int h = 0; h < 12 * 24; ++h) {
        Forcing f;
        f.air.temperature =
            270.0 + per_day * h / 24.0 - 5.0 * std::cos(2.0 * std::numbers::pi * h / 24.0);
        f.longwave_down = longwave;
        weather.instant.push_back(later(parse_instant("2026-03-01T00:00:00Z"), 3600.0 * h));
        weather.sample.push_back(f);
    }
    return weather;
}

Scene span(double from_h, double hours) {
    Scene scene;
    scene.time.start = later(parse_instant("2026-03-02T00:00:00Z"), 3600.0 * from_h);
    scene.time.duration = 3600.0 * hours;
    return scene;
}

}  // namespace

TEST_CASE("the air above is that of the mean of whole days", "[scenes][air]") {
    Weather whole = warming(0.0), evening = whole, morning = whole;
    take_upper_air(span(0.0, 24.0), 0.0, whole);
    take_upper_air(span(18.0, 3.0), 0.0, evening);
    take_upper_air(span(1.0, 0.5), 0.0, morning);
    const Profile expected = seasonal_profile(0.0, 270.0);
    REQUIRE(whole.above);
    for (std::size_t i = 0; i < expected.temperature.size(); ++i) {
        CHECK(whole.above->temperature[i] == Approx(expected.temperature[i]).margin(0.01));
        CHECK(evening.above->temperature[i] == whole.above->temperature[i]);
        CHECK(morning.above->temperature[i] == whole.above->temperature[i]);
    }
    CHECK(whole.warnings.empty());

    Scene named = span(0.0, 24.0);
    named.air.profile = "MLW";
    named.air.by_season = false;
    Weather own = warming(0.0);
    take_upper_air(named, 0.0, own);
    CHECK(!own.above);
    CHECK(upper_air(named, own)->name == "MLW");
}

TEST_CASE("days far from the mean of a span are warned of", "[scenes][air][warnings]") {
    Weather weather = warming(2.0);
    take_upper_air(span(0.0, 240.0), 0.0, weather);
    REQUIRE(weather.warnings.size() == 1);
    // Days of 273 to 291 K (2 K a day from the middle of 2 March on); the mean is 282 K.
    CHECK_THAT(weather.warnings[0].line(),
               Catch::Contains("273 to 291 K") && Catch::Contains("282 K"));
    Weather measured = warming(2.0, 300.0), calm = warming(0.5);
    take_upper_air(span(0.0, 240.0), 0.0, measured);
    take_upper_air(span(0.0, 240.0), 0.0, calm);
    CHECK(measured.warnings.empty());
    CHECK(calm.warnings.empty());
}
