#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/refused_weather.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/read_weather.hpp"

// Every excerpt is written in the published layout of its format; expected numbers are read off it
// by hand, through published conversions.

using namespace diurna;
using namespace diurna::testing;

namespace {

/// The rows of an EPW file at 106° W, 39.7° N, 1829 m, seven hours behind UTC.
std::string epw(const std::string& rows) {
    return "LOCATION,Denver,CO,USA,TMY3,724666,39.74,-105.18,-7.0,1829.0\n"
           "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
           "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,written by hand\nCOMMENTS 2,\n"
           "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n" +
           rows;
}
std::string epw_row(const std::string& time, const std::string& air, const std::string& radiation) {
    return time + ",?9?9?9?9E0?9?9?9?9?9?9?9?9?9?9?9?9?9?9?9*9*9?9?9?9," + air + ",500,1415," +
           radiation +
           ",999999,999999,999999,9999,180,4.1,10,8,16.1,77777,9,999999999,15,0.0500,0,88,999.000,"
           "2.0,1.0\n";
}

const char* tmy3_columns =
    "Date (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),ETRN (W/m^2),GHI (W/m^2),GHI source,GHI uncert "
    "(%),DNI (W/m^2),DNI source,DNI uncert (%),DHI (W/m^2),DHI source,DHI uncert (%),GH illum "
    "(lx),GH illum source,Global illum uncert (%),DN illum (lx),DN illum source,DN illum uncert "
    "(%),DH illum (lx),DH illum source,DH illum uncert (%),Zenith lum (cd/m^2),Zenith lum "
    "source,Zenith lum uncert (%),TotCld (tenths),TotCld source,TotCld uncert (code),OpqCld "
    "(tenths),OpqCld source,OpqCld uncert (code),Dry-bulb (C),Dry-bulb source,Dry-bulb uncert "
    "(code),Dew-point (C),Dew-point source,Dew-point uncert (code),RHum (%),RHum source,RHum "
    "uncert (code),Pressure (mbar),Pressure source,Pressure uncert (code),Wdir (degrees),Wdir "
    "source,Wdir uncert (code),Wspd (m/s),Wspd source,Wspd uncert (code),Hvis (m),Hvis "
    "source,Hvis uncert (code),CeilHgt (m),CeilHgt source,CeilHgt uncert (code),Pwat (cm),Pwat "
    "source,Pwat uncert (code),AOD (unitless),AOD source,AOD uncert (code),Alb (unitless),Alb "
    "source,Alb uncert (code),Lprecip depth (mm),Lprecip quantity (hr),Lprecip source,Lprecip "
    "uncert (code),PresWth (METAR code),PresWth source,PresWth uncert (code)\n";
std::string tmy3_row(const std::string& time, const std::array<int, 3>& sun,
                     const std::array<double, 5>& air) {
    // sun: global, direct, diffuse; air: dry bulb, dew point, humidity, pressure, wind.
    return time + ",500,1415" +
           fmt::format(",{},1,9,{},1,9,{},1,9,0,1,9,0,1,9,0,1,9,0,1,9,10,A,7,5,A,7", sun[0], sun[1],
                       sun[2]) +
           fmt::format(",{:.1f},A,7,{:.1f},A,7,{:.0f},A,7,{:.0f},A,7,200,A,7,{:.1f},A,7", air[0],
                       air[1], air[2], air[3], air[4]) +
           ",16100,B,7,1370,B,7,1.5,E,8,0.000,?,0,0.00,?,0,3,1,D,9,00,C,8\n";
}

}  // namespace

TEST_CASE("EPW: hours end at their stamp in local standard time, nines are missing",
          "[thermal][weather_file]") {
    const ScratchFolder folder("epw");
    const auto file = folder.path / "denver.epw";
    // Dry bulb, dew point, humidity, pressure; then infrared, global, direct, diffuse.
    write_text(file, epw(epw_row("2019,7,15,11,0", "20.0,10.0,52,82000", "300,600,700,100") +
                         epw_row("2019,7,15,12,0", "24.0,10.0,41,81900", "310,800,900,110") +
                         epw_row("2019,7,15,13,0", "26.0,12.0,40,999999", "9999,9999,9999,120") +
                         epw_row("2019,7,15,14,0", "99.9,99.9,999,81700", "330,700,500,9999")));
    CHECK(weather_format(file) == WeatherFormat::epw);
    const Weather w = read_weather(file, {.elevation = 1829.0});
    // The twelfth hour is 18:00 to 19:00 UTC; its fluxes are the mean, its states those at its end.
    const Forcing noon = w.at(parse_instant("2019-07-15T18:30:00Z"));
    CHECK(noon.shortwave_down == 800.0);
    CHECK(noon.direct_normal == 900.0);
    CHECK(noon.diffuse == 110.0);
    CHECK(noon.longwave_down == 310.0);
    CHECK(noon.air.temperature == Approx(273.15 + 22.0));  // half way from 20 to 24 °C
    CHECK(noon.wind_speed == Approx(4.1));
    CHECK(noon.rain_mm_h == Approx(2.0));
    CHECK(noon.cloud_fraction == Approx(0.8));
    CHECK(noon.air.pressure == Approx(81950.0));
    CHECK(w.wind_height == 10.0);
    CHECK(w.air_height == 2.0);
    // Missing values: on the line between their neighbours, and counted.
    const Forcing next = w.at(parse_instant("2019-07-15T19:30:00Z"));
    CHECK(next.shortwave_down == Approx(750.0));
    CHECK(next.longwave_down == Approx(320.0));
    CHECK(next.air.pressure == Approx(0.5 * (81900.0 + 81800.0)));
    CAPTURE(w.note);
    CHECK(has(w.note, "values filled in gaps"));
    CHECK(has(w.note, "1 longwave_down_W_m2"));
    // The station's height counts where it is asked for and none is reported.
    CHECK(read_weather(file, {.elevation = 900.0}).height == 900.0);
    CHECK(read_weather(file, {.elevation = 900.0, .at_station = true}).height == 1829.0);
    CHECK(read_weather(file, {.elevation = 900.0, .height = 850.0, .at_station = true}).height ==
          850.0);

    // The other meaning of stamps contradicts the format; a file of another format its name.
    CHECK(has(
        message_of(file, epw(epw_row("2019,7,15,12,0", "24.0,10.0,41,81900", "310,800,900,110")),
                   {.interval = Stamp::start, .where = "s.toml:3:1: weather.interval"}),
        "weather.interval: found 'start', but the stamps of EPW files mean 'end'"));
    // A byte order mark is no content.
    const std::string one = epw(epw_row("2019,7,15,12,0", "24.0,10.0,41,81900", "310,800,900,110"));
    CHECK(message_of(file, "\xEF\xBB\xBF" + one) == "");
    CHECK(has(message_of(file, one, {.columns = {declared_column("x", "time UTC", "x")}}),
              "has a format with its own columns"));
    CHECK(has(message_of(file, "time,air_temperature_K\n"), "is named .epw"));
    // Celsius taken for kelvin.
    CHECK(has(
        message_of(folder.path / "own.csv", "time,air_temperature_K\n2026-07-15T00:00:00Z,24.0\n"),
        "own.csv:2"));
    CHECK(has(message_of(file, epw(epw_row("2019,7,15,12,0", "24,0x", "310,800,900,110"))),
              "denver.epw:9"));
}

TEST_CASE("a typical year represents the requested year", "[thermal][weather_file]") {
    const ScratchFolder folder("typical");
    const auto file = folder.path / "typical.epw";
    std::string rows;
    for (const auto& [date, celsius] : {std::pair{"1988,1,31", "1.0"},
                                        {"2003,2,1", "2.0"},
                                        {"2003,2,28", "3.0"},
                                        {"1995,3,1", "4.0"}}) {
        for (int hour = 1; hour <= 24; ++hour) {
            rows += epw_row(std::string(date) + "," + std::to_string(hour) + ",0",
                            std::string(celsius) + ",0.0,50,82000", "300,0,0,0");
        }
    }
    write_text(file, epw(rows));
    const auto celsius = [&](const char* begin, const char* end, const char* at) {
        const AskedSpan span{parse_instant(begin), parse_instant(end)};
        const Weather w = read_weather(file, {.asked = span});
        CHECK(has(w.note, "a typical year"));
        return w.at(parse_instant(at)).air.temperature - 273.15;
    };
    CHECK(celsius("2026-01-31T00:00:00-07:00", "2026-02-02T00:00:00-07:00",
                  "2026-01-31T12:00:00-07:00") == Approx(1.0));
    CHECK(celsius("2027-02-28T12:00:00-07:00", "2027-03-01T12:00:00-07:00",
                  "2027-03-01T02:00:00-07:00") == Approx(4.0));
    // No typical year has a 29 February: in a leap year the day before represents it.
    const auto leap = [&](const char* at) {
        return celsius("2028-02-28T12:00:00-07:00", "2028-03-01T12:00:00-07:00", at);
    };
    CHECK(leap("2028-02-29T02:00:00-07:00") == Approx(3.0));
    CHECK(leap("2028-02-29T22:00:00-07:00") == Approx(3.0));
    CHECK(leap("2028-03-01T02:00:00-07:00") == Approx(4.0));
}

TEST_CASE("TMY3: 24:00 is midnight, wind and air are of the stamp", "[thermal][weather_file]") {
    const ScratchFolder folder("tmy3");
    const auto file = folder.path / "723170TYA.CSV";
    write_text(file,
               std::string("723170,\"SOMEWHERE, BY HAND\",NC,-5.0,36.100,-79.950,273\n") +
                   tmy3_columns +
                   tmy3_row("07/15/1988,22:00", {120, 30, 100}, {20.0, 15.0, 73.0, 990.0, 2.0}) +
                   tmy3_row("07/15/1988,23:00", {40, 0, 40}, {19.0, 15.0, 78.0, 991.0, 3.0}) +
                   tmy3_row("07/15/1988,24:00", {0, 0, 0}, {17.0, -9900.0, -9900.0, 992.0, 1.0}) +
                   tmy3_row("07/16/1988,01:00", {-9900, 0, 0}, {16.0, 14.0, 88.0, 992.0, 1.0}));
    CHECK(weather_format(file) == WeatherFormat::tmy3);
    const Weather w = read_weather(file);
    CHECK(w.instant.front() == parse_instant("1988-07-16T02:30:00Z"));  // 21 to 22 h, EST
    CHECK(w.instant[2] == parse_instant("1988-07-16T04:30:00Z"));
    const Forcing late = w.sample[1];
    CHECK(late.shortwave_down == 40.0);
    CHECK(late.direct_normal == 0.0);
    CHECK(late.diffuse == 40.0);
    CHECK(late.air.temperature == Approx(273.15 + 19.5));
    CHECK(late.air.pressure == Approx(99050.0));
    CHECK(late.wind_speed == Approx(2.5));
    CHECK(late.cloud_fraction == Approx(0.5));
    CHECK(late.rain_mm_h == Approx(3.0));
    CHECK(std::isnan(w.sample.back().shortwave_down));  // missing at the end: modelled
}

TEST_CASE("SURFRAD: minutes end at their stamp, flags separate bad from good",
          "[thermal][weather_file]") {
    const ScratchFolder folder("surfrad");
    const auto file = folder.path / "abc19196.dat";
    const std::string header = " Somewhere\n   40.05  -88.37  230 m version 1\n";
    const auto row = [](const std::string& time, const std::string& sun, const std::string& air) {
        // sun: global, up, direct, diffuse, longwave; air: temperature, humidity, wind, dir, p.
        return " 2019 196  7 15" + time + sun +
               "    22.0 0    22.0 0   450.0 0    25.0 0    25.0 0" +
               " -9999.9 1 -9999.9 1   800.0 0   -80.0 0   720.0 0" + air + "\n";
    };
    write_text(file,
               header +
                   row(" 18  0 18.000  20.00", "   900.0 0   180.0 0   850.0 0   100.0 0   380.0 0",
                       "    25.0 0    50.0 0     3.0 0   180.0 0   985.0 0") +
                   row(" 18  1 18.017  20.00", "   904.0 0   182.0 0   990.0 1   104.0 2   382.0 0",
                       "    25.2 0    50.0 0     3.2 0   180.0 0 -9999.9 1") +
                   row(" 18  2 18.033  20.00", "   908.0 0   184.0 0   870.0 0   108.0 0   384.0 0",
                       "    25.4 0    50.0 0     3.4 0   180.0 0   985.4 0"));
    CHECK(weather_format(file) == WeatherFormat::surfrad);
    const Weather w = read_weather(file);
    REQUIRE(w.instant.size() == 3);
    CHECK(w.instant[1] == parse_instant("2019-07-15T18:00:30Z"));
    CHECK(w.wind_height == 10.0);
    CHECK(w.air_height == 10.0);
    CHECK(w.sample[1].shortwave_down == 904.0);
    CHECK(w.sample[1].shortwave_up == 182.0);
    CHECK(w.sample[1].direct_normal == Approx(860.0));  // 990 was flagged bad
    CHECK(w.sample[1].diffuse == 104.0);                // questionable, used
    CHECK(w.sample[1].longwave_down == 382.0);
    CHECK(w.sample[1].air.temperature == Approx(298.35));
    CHECK(w.sample[1].air.pressure == Approx(98520.0));
    CHECK(w.sample[1].wind_speed == 3.2);
    CAPTURE(w.note);
    CHECK(has(w.note, "1 value flagged bad"));
    CHECK(has(w.note, "1 value flagged questionable"));
    CHECK(has(message_of(file, header + " 2019 196  7 15 18  0 18.000\n"), "abc19196.dat:3"));
    CHECK(has(message_of(file, "1 2 3\n4 5 6\n"), "is named .dat"));
}

TEST_CASE("BSRN: minutes start at their stamp, latitude from the south pole",
          "[thermal][weather_file]") {
    const ScratchFolder folder("bsrn");
    const auto file = folder.path / "abc0719.dat";
    // GCOS-174: a month of station 99; two lines a minute; -999 and -99.9 missing.
    write_text(file,
               "*U0001\n 99  7 2019  1\n"
               "     2     3    21    22    23\n"
               "*U0004\n -1 -1 -1\n 11  2\nSomewhere\n012345                012345\n"
               "XXX             nobody@example.org\n 130.050  91.630  230 XXXXX\n -1 -1 -1\n"
               "  0  0 180  0  -1 -1\n"
               "*C0100\n"
               " 15 1080    900   1.0  898  902    850   1.0  848  852\n"
               "            100   1.0   98  102    380   0.1  379  381     25.0  50.0  985\n"
               " 15 1081    904   1.0  898  902   -999 -99.9 -999 -999\n"
               "            104   1.0   98  102    382   0.1  379  381     25.2 -99.9  985\n"
               " 15 1082    908   1.0  898  902    870   1.0  848  852\n"
               "            108   1.0   98  102    384   0.1  379  381     25.4  52.0 -999\n"
               "*C0300\n"
               " 15 1080    180   1.0  178  182    440   0.1  439  441   -999 -99.9 -999 -999\n");
    CHECK(weather_format(file) == WeatherFormat::bsrn);
    const Site site{.latitude_deg = 40.05, .longitude_deg = -88.37, .height = 230.0};
    const Weather w = read_weather(file, {.elevation = 230.0, .site = site});
    REQUIRE(w.instant.size() == 3);
    CHECK(w.instant[0] == parse_instant("2019-07-15T18:00:30Z"));
    CHECK(w.sample[0].shortwave_down == 900.0);
    CHECK(w.sample[0].shortwave_up == 180.0);
    CHECK(w.sample[0].direct_normal == 850.0);
    CHECK(w.sample[1].direct_normal == Approx(860.0));
    CHECK(w.sample[1].diffuse == 104.0);
    CHECK(w.sample[1].longwave_down == 382.0);
    CHECK(w.sample[1].air.temperature == Approx(298.35));
    CHECK(w.sample[1].air.pressure == Approx(98500.0));
    // 51 % between 50 and 52 of what water at 25.2 °C gives: 32.06 hPa (WMO-No. 8, 4.B: Magnus).
    const double magnus = 611.2 * std::exp(17.62 * 25.2 / (243.12 + 25.2));
    CHECK(w.sample[1].air.vapour_pressure == Approx(0.51 * magnus).epsilon(2e-3));
    CHECK(has(w.note, "wind 1 m/s"));
    CHECK_FALSE(has(w.note, "away"));
}

TEST_CASE("a SURFRAD day as NOAA wrote it is read as such", "[thermal][weather_file]") {
    const auto folder = shared_data("data/thermal/surfrad_alamosa_20160101");
    if (!folder) return;
    const AskedSpan day{parse_instant("2016-01-01T00:00:00Z"),
                        parse_instant("2016-01-02T00:00:00Z")};
    const Weather w = read_weather(*folder / "slv16001.dat",
                                   {.elevation = 2317.0,
                                    .asked = day,
                                    .site = Site{.latitude_deg = 37.70, .longitude_deg = -105.92}});
    CHECK(w.instant.size() == 1440);
    // Its first line: 0:00, -1.8 global, -0.8 up, 1.8 direct, 2.3 diffuse, 186.3 longwave, -7.6 °C,
    // 52.7 %, 3.1 m/s, 773.5 hPa.
    CHECK(w.instant.front() == parse_instant("2015-12-31T23:59:30Z"));
    CHECK(w.sample.front().shortwave_down == -1.8);
    CHECK(w.sample.front().longwave_down == 186.3);
    CHECK(w.sample.front().air.temperature == Approx(265.55));
    CHECK(w.sample.front().wind_speed == 3.1);
    CHECK(w.sample.front().air.pressure == Approx(77350.0));
    CAPTURE(w.note);
    CHECK(has(w.note, "ends 1 min before the end of the span"));
    CHECK_FALSE(has(w.note, "away"));  // its 105.92 are degrees west
}
