#include "thermal/weather/weather.hpp"

#include <catch2/catch.hpp>

#include "materials/base/error.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

using namespace diurna;

namespace {

const std::string header = "time,air_temperature_K,wind_speed_m_s,shortwave_down_W_m2\n";

std::string message_of(const std::filesystem::path& file, const std::string& text) {
    write_text(file, text);
    try {
        read_weather(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a mean counts in the middle of its interval, an instant where it stands",
          "[thermal][weather]") {
    const ScratchFolder folder("weather");
    const auto file = folder.path / "w.csv";
    write_text(file, header +
                         "2020-06-01T00:00:00Z,280,1,0\n2020-06-01T01:00:00Z,290,3,100\n"
                         "2020-06-01T02:00:00Z,300,5,\n");
    const Instant t = parse_instant("2020-06-01T00:30:00Z");
    CHECK(read_weather(file, {.interval = Stamp::instant}).at(t).air.temperature == 285.0);
    CHECK(read_weather(file, {.interval = Stamp::end}).at(t).air.temperature == 290.0);
    CHECK(read_weather(file, {.interval = Stamp::start}).at(t).air.temperature == 280.0);
    const Weather weather = read_weather(file, {.interval = Stamp::instant, .elevation = 1000.0});
    CHECK(weather.at(t).wind_speed == 2.0);
    CHECK(weather.at(t).shortwave_down == 50.0);
    CHECK(weather.at(t).air.pressure == Approx(89875.0).epsilon(1e-3));  // US Standard 1976, 1 km
    // Beside an empty cell nothing is measured; beyond the ends the last row stays.
    CHECK(std::isnan(weather.at(later(t, 3600.0)).shortwave_down));
    CHECK(weather.at(later(t, 1e6)).air.temperature == 300.0);
    CHECK(weather.at(later(t, -1e6)).air.temperature == 280.0);
    CHECK(weather.note.find("longwave") != std::string::npos);
}

TEST_CASE("mistakes in a weather file are reported with their place",
          "[thermal][weather][errors]") {
    const ScratchFolder folder("weather_bad");
    const auto file = folder.path / "w.csv";
    const std::string row = "2020-06-01T00:00:00Z,280,1,0\n";
    CHECK(message_of(file, header + row) == "");
    CHECK(message_of(file, header + "2020-06-01T00:00:00Z,28O,1,0\n").find("w.csv:2:2") !=
          std::string::npos);
    CHECK(message_of(file, header + "2020-06-01T00:00:00Z,280,-1,0\n").find("wind_speed_m_s") !=
          std::string::npos);
    CHECK(message_of(file, header + row + row).find("w.csv:3:1") != std::string::npos);
    CHECK(message_of(file, header) != "");
    CHECK(message_of(file, "time,air_temperature_C\n2020-06-01T00:00:00Z,20\n")
              .find("air_temperature_K") != std::string::npos);
    CHECK(message_of(file, header + "2020-06-01 noon,280,1,0\n") != "");
    CHECK_THROWS_AS(read_weather(folder.path / "absent.csv"), InputError);
}
