#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/support/refused_weather.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/era5_units.hpp"
#include "thermal/weather_file/own_csv.hpp"
#include "thermal/weather_file/stamps.hpp"

// Layouts of weather files that services and loggers write beside the usual ones.

using namespace diurna;
using namespace diurna::testing;
using Catch::Contains;

namespace {

Instant instant(const std::string& text) { return parse_instant(text); }

/// Rows every `hours` from 2023-07-01T00:00Z on, with sums since midnight of 360 kJ/m² an hour.
Era5Series land_sums(int hours, int rows) {
    Era5Series series{.file = "land.nc", .format = "ERA5 netCDF"};
    for (int i = 1; i <= rows; ++i) {
        const int summed = (i * hours - 1) % 24 + 1;
        add_stamp(series, later(instant("2023-07-01T00:00:00Z"), 3600.0 * hours * i),
                  fmt::format("land.nc[{}]", i));
        series.values["t2m"].push_back(290.0);
        series.values["ssrd"].push_back(360e3 * summed);
    }
    return series;
}

}  // namespace

TEST_CASE("ERA5's units and other names are those of its attributes", "[thermal][weather_file]") {
    CHECK(era5_name_of("avg_sdswrf") == "ssrd");
    CHECK(era5_name_of("var167") == "t2m");
    CHECK(era5_name_of("u100").empty());
    const auto value = [](const char* name, const char* variable, const char* units, double read) {
        const Era5Unit unit = era5_unit(name, variable, units, "x.nc");
        return unit.factor * read + unit.offset;
    };
    // 100 W/m² for an hour are 360 kJ/m²; 1 mm of water is 1 kg/m².
    CHECK(value("ssrd", "ssrd", "W m**-2", 100.0) == Approx(360e3));
    CHECK(value("strd", "strd", "kJ m**-2", 360.0) == Approx(360e3));
    CHECK(value("ssrd", "avg_sdswrf", "", 100.0) == Approx(360e3));
    CHECK(value("tp", "tp", "mm", 1.0) == Approx(1e-3));
    CHECK(value("tp", "avg_tprate", "kg m**-2 s**-1", 1.0 / 3600.0) == Approx(1e-3));
    CHECK(value("t2m", "t2m", "degC", 15.0) == Approx(288.15));
    CHECK(value("sp", "sp", "hPa", 1000.0) == Approx(1e5));
    CHECK(value("ssrd", "ssrd", "", 5.0) == 5.0);
    CHECK_THROWS_WITH(era5_unit("ssrd", "ssrd", "furlong", "x.nc"),
                      Contains("x.nc: units") && Contains("'furlong'") && Contains("J m-2"));
}

TEST_CASE("ERA5-Land's sums are means between rows of 1, 3 and 6 hours",
          "[thermal][weather_file]") {
    const int hours = GENERATE(1, 3, 6);
    const WeatherTable table = era5_table(land_sums(hours, 48 / hours));
    for (const double flux : table.of(Quantity::shortwave_down)) {
        CHECK(flux == Approx(100.0).epsilon(1e-12));
    }
    CHECK(table.stamps == Stamp::end);
}

// ECMWF, ERA5 data documentation: "accumulations are over the hour ending at the validity time".
TEST_CASE("ERA5's radiation of every sixth hour is of the half hour before",
          "[thermal][weather_file]") {
    Era5Series series = land_sums(6, 4);
    series.values["ssrd"] = {360e3, 3600e3, 1800e3, 0.0};
    const WeatherTable table = era5_table(std::move(series));
    CHECK(table.of(Quantity::shortwave_down)[1] == Approx(1000.0));
    CHECK(table.stamps == Stamp::instant);
    CHECK(table.light_offset == -1800.0);
}

TEST_CASE("rows with the newest first are read from the last on", "[thermal][weather_file]") {
    const ScratchFolder folder("newest");
    const auto file = folder.path / "w.csv";
    write_text(file,
               "time,air_temperature_K\n2023-07-01T02:00:00Z,292\n2023-07-01T01:00:00Z,291\n"
               "2023-07-01T00:00:00Z,290\n");
    const WeatherTable table = read_own_csv(file, {}, {}, 0);
    CHECK(table.stamp.front() == instant("2023-07-01T00:00:00Z"));
    CHECK(table.of(Quantity::air_temperature) == std::vector<double>{290.0, 291.0, 292.0});
    CHECK(table.where.front() == file.string() + ":4:1");
    REQUIRE(table.notes.size() == 1);
    CHECK_THAT(table.notes.front(), Contains("newest is first"));
    // Rows in disorder are not.
    write_text(file,
               "time,air_temperature_K\n2023-07-01T02:00:00Z,292\n2023-07-01T00:00:00Z,290\n"
               "2023-07-01T01:00:00Z,291\n");
    CHECK_THROWS_WITH(read_own_csv(file, {}, {}, 0), Contains("times must ascend"));
}

TEST_CASE("marks of loggers are missing values", "[thermal][weather_file]") {
    const ScratchFolder folder("marks");
    const auto file = folder.path / "w.csv";
    std::string text = "time,air_temperature_K,wind_speed_m_s\n";
    int hour = 0;
    for (const char* mark : {"nan", "NAN", "NaN", "N/A", "#N/A", "--", "---", "null", "NULL", ""}) {
        text += fmt::format("2023-07-01T{:02}:00:00Z,290,{}\n", hour++, mark);
    }
    write_text(file, text);
    const WeatherTable table = read_own_csv(file, {}, {}, 0);
    for (const double wind : table.of(Quantity::wind_speed)) CHECK(std::isnan(wind));
}

// Campbell Scientific, TOA5: environment line, names, units, processing, data.
TEST_CASE("a TOA5 table is read below its four lines", "[thermal][weather_file]") {
    const ScratchFolder folder("toa5");
    const auto file = folder.path / "w.dat";
    write_text(file,
               "\"TOA5\",\"CR1000\",\"CR1000\",\"1234\",\"CR1000.Std.31\",\"CPU:a.CR1\",\"1\",\"T\""
               "\n\"TIMESTAMP\",\"RECORD\",\"AirTC_Avg\"\n\"TS\",\"RN\",\"Deg C\"\n\"\",\"\","
               "\"Avg\"\n\"2023-07-01 00:10:00\",1,20.5\n\"2023-07-01 00:20:00\",2,\"NAN\"\n"
               "\"2023-07-01 00:30:00\",3,21.5\n");
    const std::vector<DeclaredColumn> columns{
        declared_column("TIMESTAMP", "time -07:00", "x"),
        declared_column("AirTC_Avg", "air_temperature degC", "x")};
    const WeatherTable table = read_own_csv(file, columns, {}, 0);
    REQUIRE(table.stamp.size() == 3);
    CHECK(table.stamp.front() == instant("2023-07-01T07:10:00Z"));
    CHECK(table.of(Quantity::air_temperature)[0] == Approx(293.65));
    CHECK(std::isnan(table.of(Quantity::air_temperature)[1]));
}

TEST_CASE("times in digits alone, and 24:00, are instants", "[thermal][weather_file]") {
    const auto read = [](const char* text) { return stamp_in(text, -5.0, "x"); };
    CHECK(read("202307070030") == instant("2023-07-07T05:30:00Z"));
    CHECK(read("20230707003015") == instant("2023-07-07T05:30:15Z"));
    CHECK(read("20230707") == instant("2023-07-07T05:00:00Z"));
    CHECK(read("2023-07-07 24:00") == instant("2023-07-08T05:00:00Z"));
    CHECK(read("2023-12-31T24:00:00Z") == instant("2024-01-01T00:00:00Z"));
    CHECK_THROWS_AS(read("2023070"), InputError);
    CHECK_THROWS_AS(read("202313070030"), InputError);
}
