#include "thermal/weather_file/changed_weather.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/weather_file/read_weather.hpp"

using namespace diurna;

// Weather that is changed to ask what follows from its errors.

namespace {

/// A day at 290 K, more moist than saturated, with measured sun.
std::string moist_day() {
    std::string text =
        "time,air_temperature_K,relative_humidity,wind_speed_m_s,shortwave_down_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        text += fmt::format("2026-06-{:02}T{:02}:00:00Z,290,1.05,3,200\n", 21 + h / 24, h % 24);
    }
    return text;
}

Weather changed(const WeatherChange& change) {
    const ScratchFolder folder("changed_weather");
    write_text(folder.path / "weather.csv", moist_day());
    WeatherOptions options;
    options.change = change;
    return read_weather(folder.path / "weather.csv", options);
}

}  // namespace

TEST_CASE("weather that nobody changes is what was measured",
          "[thermal][weather_file][by_degenerate]") {
    const Weather weather = changed({});
    const double saturated = saturation_vapour_pressure(290.0);
    for (const Forcing& sample : weather.sample) {
        CHECK(sample.air.vapour_pressure == Approx(1.05 * saturated));  // and not cut off there
    }
    CHECK(weather.note.find("changed") == std::string::npos);
}

TEST_CASE("each factor changes what it says and nothing else",
          "[thermal][weather_file][by_variation]") {
    const double vapour = 1.05 * saturation_vapour_pressure(290.0);
    const Forcing windy = changed({.wind = 2.0}).sample[5];
    CHECK(windy.wind_speed == Approx(6.0));
    CHECK(windy.air.vapour_pressure == Approx(vapour));
    CHECK(windy.shortwave_down == Approx(200.0));
    const Forcing dull = changed({.sunlight = 0.5}).sample[5];
    CHECK(dull.shortwave_down == Approx(100.0));
    CHECK(std::isnan(dull.diffuse));
    const Forcing dry = changed({.humidity = 0.5}).sample[5];
    CHECK(dry.air.vapour_pressure == Approx(0.5 * vapour));
    CHECK(dry.air.temperature == 290.0);
    // WMO-No. 8, 4.B: 6.112 exp(17.62 t / (243.12 + t)) hPa, at 26.85 and 6.85 degrees Celsius.
    const Forcing warm = changed({.warmer = 10.0, .humidity = 9.0}).sample[5];
    CHECK(warm.air.temperature == Approx(300.0));
    CHECK(warm.air.vapour_pressure ==
          Approx(611.2 * std::exp(17.62 * 26.85 / 269.97)).epsilon(2e-3));
    const Forcing cold = changed({.warmer = -10.0}).sample[5];
    CHECK(cold.air.vapour_pressure ==
          Approx(611.2 * std::exp(17.62 * 6.85 / 249.97)).epsilon(2e-3));
    CHECK(changed({.warmer = 1.0}).note.find("changed: air + K 1") != std::string::npos);
    CHECK_THROWS_AS(changed({.longwave = 1.1}), InputError);  // none was measured
}

TEST_CASE("a column that only its film warms is as much warmer as the air",
          "[thermal][column_tool][by_variation]") {
    // White, without emission, dry and insulated: at rest it has the air's temperature.
    const ScratchFolder folder("changed_column");
    write_text(folder.path / "weather.csv", moist_day());
    const auto surface = [&](const std::string& more) {
        write_text(folder.path / "column.toml", R"([site]
latitude_deg = 40.0
longitude_deg = 0.0
[material]
albedo = 1.0
emissivity = 0.0
roughness_length_m = 0.02
layers = [{ thickness_m = 0.01, conductivity_W_mK = 1.0, density_kg_m3 = 1000.0, heat_capacity_J_kgK = 1000.0 }]
convection = { kind = "constant", value_W_m2K = 20.0 }
[weather]
file = "weather.csv"
interval = "instant"
)" + more + R"([time]
start = 2026-06-21T00:00:00Z
end = 2026-06-22T00:00:00Z
)");
        return run_column(read_column_job(folder.path / "column.toml")).row.at(20);
    };
    CHECK(surface("").surface_temperature == Approx(290.0).margin(0.01));
    CHECK(surface("changed = {}\n").surface_temperature == Approx(290.0).margin(0.01));
    CHECK(surface("changed = { air_temperature_offset_K = 7.5 }\n").surface_temperature ==
          Approx(297.5).margin(0.01));
}
