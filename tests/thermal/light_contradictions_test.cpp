#include "thermal/weather/light_contradictions.hpp"

#include <catch2/catch.hpp>

using namespace diurna;
using Catch::Contains;

namespace {

const Site site{36.0, 0.0, 0.0};

/// Hours from 10 to 14 UTC under a sun of 60 degrees and more.
Weather hours(const Forcing& each) {
    Weather weather;
    for (int h = 10; h <= 14; ++h) {
        weather.instant.push_back(later(parse_instant("2026-07-15T00:00:00Z"), 3600.0 * double(h)));
        weather.sample.push_back(each);
    }
    return weather;
}

std::vector<Mistake> found(const Weather& weather) {
    return light_contradictions(weather, site, weather.instant.front(), weather.instant.back(),
                                "weather.file");
}

Forcing forcing(double global, double direct, double diffuse, double cloud = not_measured) {
    Forcing f;
    f.shortwave_down = global;
    f.direct_normal = direct;
    f.diffuse = diffuse;
    f.cloud_fraction = cloud;
    return f;
}

}  // namespace

TEST_CASE("global light far off the sum of its parts is reported once with both numbers",
          "[thermal][weather][warnings]") {
    // 800 sin(75.5°) + 300 = 1075 at noon of 15 July at 36° north.
    Weather weather = hours(forcing(500.0, 800.0, 300.0));
    const auto warnings = found(weather);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].line(), Contains("shortwave_down_W_m2 = 500") && Contains("4 more") &&
                                       Contains("= 800") && Contains("= 300"));
    weather.sample.assign(5, forcing(1040.0, 800.0, 300.0));  // 3 to 8 % off: instruments
    CHECK(found(weather).empty());
    weather.sample.assign(5, forcing(0.0, 0.0, 0.0));
    CHECK(found(weather).empty());
}

TEST_CASE("diffuse light above the global is reported", "[thermal][weather][warnings]") {
    const auto warnings = found(hours(forcing(200.0, not_measured, 300.0)));
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].line(), Contains("300") && Contains("200") && Contains("4 more"));
    CHECK(found(hours(forcing(200.0, not_measured, 208.0))).empty());
    CHECK(found(hours(forcing(200.0, not_measured, not_measured))).empty());
}

TEST_CASE("a beam above the global and light that comes back from nowhere are reported",
          "[thermal][weather][warnings]") {
    // 900 sin(75.5 deg) = 871 at noon; at 10 and 14 h the sun is at 55 degrees: 740.
    const auto beams = found(hours(forcing(200.0, 900.0, not_measured)));
    REQUIRE(beams.size() == 1);
    CHECK_THAT(beams[0].line(), Contains("900") && Contains("200") && Contains("4 more"));
    CHECK(found(hours(forcing(860.0, 900.0, not_measured))).empty());
    Forcing snow = forcing(500.0, not_measured, not_measured);
    snow.shortwave_up = 600.0;
    REQUIRE(found(hours(snow)).size() == 1);
    CHECK_THAT(found(hours(snow))[0].line(), Contains("600") && Contains("500"));
    snow.shortwave_up = 470.0;
    CHECK(found(hours(snow)).empty());
}

TEST_CASE("an overcast beside a strong beam is reported", "[thermal][weather][warnings]") {
    const auto warnings = found(hours(forcing(not_measured, 800.0, 100.0, 1.0)));
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].line(), Contains("cloud_fraction = 1") && Contains("800"));
    CHECK(found(hours(forcing(not_measured, 250.0, 100.0, 1.0))).empty());
    CHECK(found(hours(forcing(not_measured, 800.0, 100.0, 0.3))).empty());
}
