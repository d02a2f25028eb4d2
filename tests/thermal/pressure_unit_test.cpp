#include <catch2/catch.hpp>
#include <string>

#include "tests/support/refused_weather.hpp"
#include "thermal/weather_file/read_weather.hpp"

using namespace diurna;

// The standard atmosphere: 1013.25 hPa at the sea, 308 hPa at 9 km (ICAO Doc 7488).
TEST_CASE("a pressure of another unit is refused, with the unit that it seems to be",
          "[thermal][weather_file][pressure]") {
    using diurna::testing::message_of;
    const ScratchFolder folder("pressure");
    const auto reported = [&](const std::string& pressure, double height = 0.0) {
        return message_of(folder.path / "w.csv",
                          "time,air_temperature_K,pressure_Pa\n"
                          "2026-01-10T00:00:00Z,285,101325\n2026-01-10T01:00:00Z,285," +
                              pressure + "\n",
                          {.elevation = height});
    };
    CHECK(reported("101325").empty());
    CHECK(reported("31000", 8800.0).empty());
    CHECK(reported("29000", 9000.0).empty());  // within a tenth of that height's
    CHECK_THAT(reported("1013.25"), Catch::Contains("w.csv:3") && Catch::Contains("pressure_Pa") &&
                                        Catch::Contains("seems to be hPa") &&
                                        Catch::Contains("pressure hPa"));
    CHECK_THAT(reported("850", 1500.0), Catch::Contains("seems to be hPa"));
    CHECK_THAT(reported("101.325"), Catch::Contains("seems to be kPa"));
    CHECK_THAT(reported("25000"),
               Catch::Contains("expected 30000 to 110000") && !Catch::Contains("seems to be"));
}
