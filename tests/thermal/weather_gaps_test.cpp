#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/refused_weather.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather/sky_series.hpp"
#include "thermal/weather/sky_state.hpp"
#include "thermal/weather_file/read_weather.hpp"

// What a file does not hold: before its start, behind its end and in between.

using namespace diurna;
using namespace diurna::testing;

namespace {

const std::string header =
    "time,air_temperature_K,wind_speed_m_s,shortwave_down_W_m2,longwave_down_W_m2\n";

/// Hourly rows of June 2020 from hour `from` to hour `to`: T = 280 + h, wind h / 10, sun 10 h,
/// longwave 300 + h; except for hours between `out_from` and `out_to`, both skipped.
std::string hours(int from, int to, int out_from = -1, int out_to = -2) {
    std::string rows;
    for (int h = from; h <= to; ++h) {
        if (h >= out_from && h <= out_to) continue;
        rows += fmt::format("2020-06-{:02}T{:02}:00:00Z,{},{},{},{}\n", 1 + h / 24, h % 24, 280 + h,
                            0.1 * h, 10 * h, 300 + h);
    }
    return header + rows;
}

Instant at_hour(double h) { return later(parse_instant("2020-06-01T00:00:00Z"), 3600.0 * h); }

}  // namespace

TEST_CASE("a span outside the file is refused with both spans in one line",
          "[thermal][weather_file][errors]") {
    const ScratchFolder folder("cover");
    const auto file = folder.path / "w.csv";
    write_text(file, hours(0, 23));
    const auto refusal = [&](double begin, double end, Stamp stamps) {
        return refused(file, {.interval = stamps, .asked = {at_hour(begin), at_hour(end)}});
    };
    const std::string line = refusal(-4000.0, -3976.0, Stamp::end);
    CAPTURE(line);
    CHECK(has(line,
              "has weather from 2020-05-31T23:00:00Z to 2020-06-01T23:00:00Z, expected "
              "2019-12-17T08:00:00Z to 2019-12-18T08:00:00Z"));
    CHECK(line.find('\n') >= line.size() - 1);
    // 24 rows are a day, whatever their stamps mean: an hour at most is held at either end.
    for (const Stamp stamps : {Stamp::start, Stamp::end, Stamp::instant}) {
        CAPTURE(int(stamps));
        CHECK(refusal(0.0, 24.0, stamps) == "");
        CHECK(refusal(0.0, 26.0, stamps) != "");
        CHECK(refusal(-3.0, 20.0, stamps) != "");
    }
    CHECK(refusal(-1.0, 25.0, Stamp::start) == "");  // covers 0 to 24 h
    CHECK(refusal(-2.0, 24.0, Stamp::end) == "");    // covers −1 to 23 h
    CHECK(refusal(-2.1, 24.0, Stamp::end) != "");
    CHECK(refusal(0.0, 24.1, Stamp::end) != "");
    const Weather held =
        read_weather(file, {.interval = Stamp::instant, .asked = {at_hour(0), at_hour(24)}});
    CHECK(has(held.note, "the file ends 60 min before the end of the span; its last row is used"));
    CHECK(held.at(at_hour(24)).air.temperature == 303.0);
    const Weather whole =
        read_weather(file, {.interval = Stamp::start, .asked = {at_hour(0), at_hour(24)}});
    CHECK_FALSE(has(whole.note, "held"));
}

TEST_CASE("missing rows: three hours are filled, more are refused, filled or left to the sky",
          "[thermal][weather_file]") {
    const ScratchFolder folder("gaps");
    const auto file = folder.path / "w.csv";
    const AskedSpan day{at_hour(0), at_hour(24)};
    // Two rows missing: 3 h from the one before to the one behind.
    write_text(file, hours(0, 24, 10, 11));
    const Weather small = read_weather(file, {.interval = Stamp::instant, .asked = day});
    CHECK(small.at(at_hour(10.5)).air.temperature == Approx(290.5));
    CAPTURE(small.note);
    CHECK(has(small.note,
              "8 values filled in gaps: 2 air_temperature_K, 2 wind_speed_m_s, 2 "
              "shortwave_down_W_m2, 2 longwave_down_W_m2 by linear interpolation"));
    // Three rows: 4 h.
    write_text(file, hours(0, 24, 10, 12));
    const auto with = [&](OnGap on_gap, AskedSpan span) {
        return WeatherOptions{.interval = Stamp::instant, .on_gap = on_gap, .asked = span};
    };
    const std::string line = refused(file, with(OnGap::refuse, day));
    CAPTURE(line);
    CHECK(has(line, "w.csv:12"));
    CHECK(has(line,
              "no weather between 2020-06-01T09:00:00Z and 2020-06-01T13:00:00Z (4.0 h; gaps up to "
              "3 h are filled)"));
    CHECK(has(line, "on_gap"));
    // A gap that nobody asks for is nobody's.
    CHECK(refused(file, with(OnGap::refuse, {at_hour(13), at_hour(24)})) == "");
    CHECK(refused(file, with(OnGap::refuse, {at_hour(12), at_hour(24)})) != "");

    const Weather straight = read_weather(file, with(OnGap::interpolate, day));
    CHECK(straight.at(at_hour(11)).air.temperature == Approx(291.0));
    CHECK(straight.at(at_hour(11)).shortwave_down == Approx(110.0));
    CHECK(has(straight.note, "12 values filled"));

    const Weather clear = read_weather(file, with(OnGap::clear_sky, day));
    CHECK(clear.at(at_hour(11)).air.temperature == Approx(291.0));
    CHECK(clear.at(at_hour(11)).wind_speed == Approx(1.1));
    CHECK(std::isnan(clear.at(at_hour(11)).shortwave_down));
    CHECK(std::isnan(clear.at(at_hour(11)).longwave_down));
    CHECK(clear.at(at_hour(11)).cloud_fraction == 0.0);
    CHECK(clear.at(at_hour(14)).shortwave_down == Approx(140.0));
    CAPTURE(clear.note);
    CHECK(has(clear.note,
              "12 values filled in gaps: 3 air_temperature_K, 3 wind_speed_m_s by linear "
              "interpolation, 3 shortwave_down_W_m2, 3 "
              "longwave_down_W_m2 by clear-sky formulas"));
    // What the formulas then give is the clear sky's of that air, though clouds went before.
    const Site site{.latitude_deg = 40.0, .longitude_deg = 0.0};
    const SkySeries series(clear, site, 0.0, {}, at_hour(0), at_hour(24));
    // Dilley & O'Brien 1998 of 291 K and half of its vapour pressure (WMO-No. 8: 20.44 hPa).
    const double water = 46.5 * 0.5 * 20.44 / 291.0;  // [kg m⁻²]
    const double expected =
        59.38 + 113.7 * std::pow(291.0 / 273.16, 6) + 96.96 * std::sqrt(water / 2.5);
    CHECK(series.dark(at_hour(11)).longwave_down == Approx(expected).epsilon(1e-3));
}

TEST_CASE("gaps of single quantities are found among rows that are there",
          "[thermal][weather_file]") {
    const ScratchFolder folder("cells");
    const auto file = folder.path / "w.csv";
    std::string text = header;
    for (int h = 0; h <= 24; ++h) {
        text += fmt::format("2020-06-{:02}T{:02}:00:00Z,{},{},{},\n", 1 + h / 24, h % 24, 280 + h,
                            h >= 4 && h <= 9 ? "" : "2", 10 * h);
    }
    write_text(file, text);
    const AskedSpan day{at_hour(0), at_hour(24)};
    const std::string line = refused(file, {.interval = Stamp::instant, .asked = day});
    CAPTURE(line);
    CHECK(has(line, "no wind_speed_m_s between 2020-06-01T03:00:00Z and 2020-06-01T10:00:00Z"));
    const Weather w = read_weather(
        file, {.interval = Stamp::instant, .on_gap = OnGap::interpolate, .asked = day});
    CHECK(w.at(at_hour(6)).wind_speed == 2.0);
    CHECK(has(w.note, "6 values filled in gaps: 6 wind_speed_m_s"));
    CHECK(has(w.note, "longwave"));  // its column is empty throughout
}

TEST_CASE("sunlight that a file omits at night is zero", "[thermal][weather_file]") {
    const ScratchFolder folder("night");
    const auto file = folder.path / "w.csv";
    std::string text = "time,air_temperature_K,direct_normal_W_m2,diffuse_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        const bool day = h >= 4 && h <= 20;  // 1 June at 45° N: the sun is up from 4:14 to 19:41
        text += fmt::format("2020-06-{:02}T{:02}:00:00Z,290,{},{}\n", 1 + h / 24, h % 24,
                            day ? "500" : "", day ? "80" : "");
    }
    write_text(file, text);
    const AskedSpan day{at_hour(0), at_hour(24)};
    CHECK(refused(file, {.interval = Stamp::instant, .asked = day}) != "");
    const Weather w =
        read_weather(file, {.interval = Stamp::instant,
                            .asked = day,
                            .site = Site{.latitude_deg = 45.0, .longitude_deg = 0.0}});
    CHECK(w.at(at_hour(1)).direct_normal == 0.0);
    CHECK(w.at(at_hour(23)).diffuse == 0.0);
    CHECK(w.at(at_hour(12)).direct_normal == 500.0);
}
