#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/support/refused_weather.hpp"
#include "thermal/weather_file/epw_times.hpp"

// Weather as services give it out: EPW whose hours are counted in other ways, PVGIS' series of
// hours, sums since midnight of ERA5-Land. Expected numbers by hand.

using namespace diurna;
using namespace diurna::testing;

namespace {

/// The ends of rows given as {day, hour, minute} of a July.
std::vector<double> ends_of(const std::vector<std::array<int, 3>>& times, int per_hour) {
    std::vector<EpwTime> rows;
    for (const auto& [day, hour, minute] : times) rows.push_back({2018, 7, day, hour, minute});
    std::vector<std::string> notes;
    return epw_ends(rows, per_hour, notes);
}

/// Day 8 with n rows an hour: hour and minute of the end of each interval, by the clock, and the
/// minute of its start.
struct ClockDay {
    std::vector<std::array<int, 3>> ends, starts;
    std::vector<double> seconds;  // of the ends
    explicit ClockDay(int n) {
        for (int k = 0; k < 24 * n; ++k) {
            const int begin = k * 60 / n, end = (k + 1) * 60 / n;
            starts.push_back({8, begin / 60, begin % 60});
            ends.push_back({8, end / 60, end % 60});
            seconds.push_back(60.0 * end);
        }
    }
};

}  // namespace

TEST_CASE("rows of an EPW end when its clock says, however it counts",
          "[thermal][weather_file][epw]") {
    const int n = GENERATE(2, 4, 6, 12);
    CAPTURE(n);
    const ClockDay day(n);
    CHECK(ends_of(day.ends, n) == day.seconds);    // 0:30, 1:00, ... 24:00
    CHECK(ends_of(day.starts, n) == day.seconds);  // 0:00, 0:30, ... 23:30
    // 24:00 as 0:00 of the next day, whose seconds count from that day's begin.
    auto next = day.ends;
    next.back() = {9, 0, 0};
    auto seconds = day.seconds;
    seconds.back() = 0.0;
    CHECK(ends_of(next, n) == seconds);
    // Hours 0 to 23 of minutes 60 / n to 60.
    std::vector<std::array<int, 3>> parts;
    for (int hour = 0; hour < 24; ++hour) {
        for (int k = 1; k <= n; ++k) parts.push_back({8, hour, k * 60 / n});
    }
    CHECK(ends_of(parts, n) == day.seconds);
    // An afternoon alone: 12:30, 13:00, ... 18:00 for two an hour.
    const std::vector<std::array<int, 3>> cut(day.ends.begin() + 12 * n, day.ends.begin() + 18 * n);
    const std::vector<double> of_cut(day.seconds.begin() + 12 * n, day.seconds.begin() + 18 * n);
    CHECK(ends_of(cut, n) == of_cut);
}

TEST_CASE("whole hours from 0 to 23 begin at their number", "[thermal][weather_file][epw]") {
    const ClockDay day(1);
    CHECK(ends_of(day.starts, 1) == day.seconds);
    CHECK(ends_of(day.ends, 1) == day.seconds);  // 1 to 24
}

namespace {

std::string pvgis_series(const std::string& slope, const std::string& columns,
                         const std::string& rows) {
    return "Latitude (decimal degrees):\t45.000\nLongitude (decimal degrees):\t8.000\n"
           "Elevation (m):\t250\nRadiation database:\tPVGIS-SARAH2\n\n\n" +
           slope + "Azimuth: 0 deg. \n" + columns + "\n" + rows +
           "\nG(i): Global irradiance on the inclined plane (W/m2)\n"
           "PVGIS (c) European Union, 2001-2024\n";
}

}  // namespace

TEST_CASE("PVGIS' series of hours has its sunlight of the horizontal",
          "[thermal][weather_file][pvgis]") {
    const ScratchFolder folder("pvgis_series");
    const auto file = folder.path / "series.csv";
    write_text(file, pvgis_series("Slope: 0 deg. \n", "time,Gb(i),Gd(i),Gr(i),H_sun,T2m,WS10m,Int",
                                  "20180708:1010,600.0,90.0,0.0,62.0,23.0,3.0,0.0\n"
                                  "20180708:1110,610.0,95.0,0.0,66.0,25.0,3.5,0.0\n"));
    const Weather w = read_weather(file);
    CHECK(w.instant[0] == parse_instant("2018-07-08T10:10:00Z"));
    CHECK(w.sample[0].shortwave_down == Approx(690.0));
    CHECK(w.sample[0].diffuse == Approx(90.0));
    CHECK(w.sample[1].air.temperature == Approx(298.15));
    CHECK(w.sample[1].wind_speed == Approx(3.5));
    CHECK_FALSE(has(w.note, "clear-sky sun"));
    // The whole alone, beside a PV system's power.
    write_text(file, pvgis_series("Slope: 0 deg. (optimum)\n", "time,P,G(i),H_sun,T2m,WS10m,Int",
                                  "20180708:1010,5.0,690.0,62.0,23.0,3.0,0.0\n"
                                  "20180708:1110,6.0,705.0,66.0,25.0,3.5,0.0\n"));
    CHECK(read_weather(file).sample[1].shortwave_down == Approx(705.0));
    // Light on a plane of another slope is no light on the ground.
    const std::string tilted =
        pvgis_series("Slope: 38 deg. (optimum) \n", "time,G(i),H_sun,T2m,WS10m,Int",
                     "20180708:1010,690.0,62.0,23.0,3.0,0.0\n"
                     "20180708:1110,705.0,66.0,25.0,3.5,0.0\n");
    CHECK(has(message_of(file, tilted), "series.csv:7: found 'Slope: 38 deg."));
    CHECK(has(message_of(file, pvgis_series("", "time,G(i),H_sun,T2m,WS10m,Int",
                                            "20180708:1010,690.0,62.0,23.0,3.0,0.0\n")),
              "is unknown"));
}

TEST_CASE("sums since midnight of ERA5-Land are taken apart into hours",
          "[thermal][weather_file]") {
    const ScratchFolder folder("era5_land");
    const auto file = folder.path / "land.csv";
    // 40 W/m2 in the first hour after midnight, 80 in the second, ...; longwave 300 throughout.
    std::string text = "valid_time,t2m,ssrd,strd,latitude,longitude\n";
    double sun = 0.0, sky = 0.0;
    for (int hour = 1; hour <= 24; ++hour) {
        sun += 3600.0 * 40.0 * hour;
        sky += 3600.0 * 300.0;
        text += fmt::format("2022-07-0{} {:02}:00:00,293.0,{:.1f},{:.1f},50.0,10.0\n",
                            hour == 24 ? 2 : 1, hour % 24, sun, sky);
    }
    text += "2022-07-02 01:00:00,293.0,180000.0,1080000.0,50.0,10.0\n";
    write_text(file, text);
    const Weather w = read_weather(file);
    REQUIRE(w.sample.size() == 25);
    for (int hour = 1; hour <= 24; ++hour) {
        CHECK(w.sample[std::size_t(hour - 1)].shortwave_down == Approx(40.0 * hour));
        CHECK(w.sample[std::size_t(hour - 1)].longwave_down == Approx(300.0));
    }
    CHECK(w.sample[24].shortwave_down == Approx(50.0));
    CHECK(has(w.note, "since midnight"));
}

TEST_CASE("a clock in a column of its own has hours and minutes", "[thermal][weather_file][csv]") {
    const ScratchFolder folder("clock");
    const auto file = folder.path / "logger.csv";
    WeatherOptions options;
    for (const auto& [name, says] :
         {std::pair{"Date", "date -07:00"}, {"Clock", "clock"}, {"T", "air_temperature degC"}}) {
        options.columns.push_back(declared_column(name, says, "columns"));
    }
    options.interval = Stamp::instant;
    write_text(file,
               "Date,Clock,T\n2021-07-08,9:30,11\n2021-07-08,11:00,21\n2021-07-08,13:30:30,22\n"
               "2021-07-08,1530,NaN\n2021-07-08,16:30,23\n");
    const Weather w = read_weather(file, options);
    for (const char* const clock : {"09:30:00", "11:00:00", "13:30:30", "15:30:00", "16:30:00"}) {
        CAPTURE(clock);
        const Instant when = parse_instant(std::string("2021-07-08T") + clock + "-07:00");
        CHECK(std::count(w.instant.begin(), w.instant.end(), when) == 1);
    }
}

TEST_CASE("lines above the header are skipped", "[thermal][weather_file][csv]") {
    const ScratchFolder folder("preamble");
    const auto file = folder.path / "table.csv";
    WeatherOptions options;
    options.columns = {declared_column("time", "time UTC", "columns"),
                       declared_column("t", "air_temperature degC", "columns")};
    options.interval = Stamp::instant;
    const std::string table = "time,t\n2021-07-08T00:00,10\n2021-07-08T01:00,11\n";
    write_text(file,
               "latitude,longitude,elevation,utc_offset_seconds,timezone,timezone_abbreviation\n"
               "52.5,13.4,38.0,0,GMT,GMT\n\n" +
                   table);
    CHECK(read_weather(file, options).sample[0].air.temperature == Approx(283.15));
    write_text(file, "-BEGIN HEADER-\nNASA/POWER Hourly\nT2M, C\n-END HEADER-\n" + table);
    CHECK(read_weather(file, options).instant.size() == 2);
    write_text(file, "My logger, number 7, roof\nfirmware 3\n" + table);
    options.skip_lines = 2;
    CHECK(read_weather(file, options).instant.size() == 2);
}

TEST_CASE("a code for missing values is named as the file has it", "[thermal][weather_file][csv]") {
    const ScratchFolder folder("code");
    WeatherOptions options;
    options.columns = {declared_column("time", "time", "columns"),
                       declared_column("t", "air_temperature degC", "columns")};
    const std::string said =
        message_of(folder.path / "table.csv",
                   "time,t\n2021-07-08T00:00+0000,10\n2021-07-08T01:00+0000,-9999\n", options);
    CHECK(has(said, "found -9999"));
    CHECK(has(said, "missing = [-9999]"));
}
