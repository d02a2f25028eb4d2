#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "tests/support/refused_weather.hpp"
#include "thermal/weather_file/epw_times.hpp"
#include "thermal/weather_file/time_parts.hpp"

// Weather as people have it: NSRDB, SolarAnywhere, EPW of other kinds, times in several columns,
// codes for missing values, days in several files.

using namespace diurna;
using namespace diurna::testing;

namespace {

Instant instant(const char* text) { return parse_instant(text); }

std::string epw_head(const std::string& comment, int rows_per_hour) {
    return "LOCATION,Place,-,-,-,0,45.0,8.0,1.0,250.0\nDESIGN CONDITIONS,0\n"
           "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
           "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2," +
           comment + fmt::format("\nDATA PERIODS,1,{},Data,Sunday, 7/ 8, 7/ 9\n", rows_per_hour);
}

/// Air [°C], infrared, global light [W/m2].
std::string epw_line(int hour, int minute, double air, double infrared, double global) {
    return fmt::format("2018,7,8,{},{},x,{},5,50,98000,0,0,{},{},0,0,9,9,9,9,180,2.0\n", hour,
                       minute, air, infrared, global);
}

}  // namespace

TEST_CASE("rows of an hour are its parts, whatever their minutes", "[thermal][weather_file][epw]") {
    std::vector<std::string> notes;
    const auto ends = [&](std::initializer_list<int> minutes, int per_hour) {
        std::vector<EpwTime> rows;
        for (const int hour : {1, 2}) {
            for (const int minute : minutes) rows.push_back({2018, 6, 1, hour, minute});
        }
        return epw_ends(rows, per_hour, notes);
    };
    const std::vector<double> quarters{900.0,  1800.0, 2700.0, 3600.0,
                                       4500.0, 5400.0, 6300.0, 7200.0};
    CHECK(ends({0, 15, 30, 45}, 4) == quarters);
    CHECK(ends({15, 30, 45, 60}, 4) == quarters);
    CHECK(ends({15, 30, 45, 0}, 4) == quarters);
    CHECK(ends({7, 22, 37, 52}, 4) == quarters);
    CHECK(ends({0}, 1) == std::vector<double>{3600.0, 7200.0});
    CHECK(ends({60}, 1) == std::vector<double>{3600.0, 7200.0});
    CHECK(ends({30}, 1) == std::vector<double>{3600.0, 7200.0});
    CHECK(notes.empty());
    CHECK(ends({0, 30}, 1) == std::vector<double>{1800.0, 3600.0, 5400.0, 7200.0});
    CHECK(notes.size() == 1);
    // An hour that lacks a row: its minutes mean what they mean in a whole one.
    const std::vector<EpwTime> gap{{2018, 6, 1, 1, 0}, {2018, 6, 1, 1, 30}, {2018, 6, 1, 2, 30}};
    CHECK(epw_ends(gap, 2, notes) == std::vector<double>{1800.0, 3600.0, 7200.0});
}

TEST_CASE("infrared of zero is not measured", "[thermal][weather_file][epw]") {
    const ScratchFolder folder("epw_zero");
    const auto file = folder.path / "zero.epw";
    std::string rows;
    for (int hour = 1; hour <= 24; ++hour) rows += epw_line(hour, 0, 20.0, 0.0, 0.0);
    write_text(file, epw_head("", 1) + rows);
    const Weather w = read_weather(file);
    CHECK(std::isnan(w.at(instant("2018-07-08T12:00:00Z")).longwave_down));
    CHECK(has(w.note, "infrared of 0 W/m2 in 24 rows"));
}

TEST_CASE("sunlight of PVGIS is of the instants that its comment names",
          "[thermal][weather_file][epw]") {
    const ScratchFolder folder("epw_pvgis");
    const auto file = folder.path / "tmy.epw";
    std::string rows;
    for (int hour = 1; hour <= 24; ++hour) rows += epw_line(hour, 0, hour, 330.0, 10.0 * hour);
    write_text(file, epw_head("Irradiance Time Offset (h):-0.75", 1) + rows);
    const Weather w = read_weather(file);
    // The header's zone is 1, but rows are in UTC: hour 12 is the instant 11:00, its light of 11:15
    // (pvlib's tmy_45.000_8.000_2005_2023 as EPW and as CSV have the same rows so).
    const Forcing then = w.at(instant("2018-07-08T11:15:00Z"));
    CHECK(then.shortwave_down == Approx(120.0));
    CHECK(then.air.temperature == Approx(273.15 + 12.25));  // of 12 °C at 11:00, 13 at 12:00
    CHECK(has(w.note, "the time zone 1 of its header is not used"));
}

TEST_CASE("PVGIS' own CSV has the same offset", "[thermal][weather_file]") {
    const ScratchFolder folder("pvgis_csv");
    const auto file = folder.path / "tmy.csv";
    write_text(file,
               "Latitude (decimal degrees): 45.0\nLongitude (decimal degrees): 8.0\n"
               "Elevation (m): 250.0\nIrradiance Time Offset (h): 0.25\nmonth,year\n7,2018\n"
               "time(UTC),T2m,RH,G(h),Gb(n),Gd(h),IR(h),WS10m,WD10m,SP\n"
               "20180708:1000,20,50,700,600,100,330,2,180,98000\n"
               "20180708:1100,24,50,800,650,110,332,2,180,98000\n\nT2m: 2-m air temperature\n");
    const Weather w = read_weather(file);
    const Forcing then = w.at(instant("2018-07-08T10:15:00Z"));
    CHECK(then.shortwave_down == 700.0);
    CHECK(then.air.temperature == Approx(273.15 + 21.0));
    CHECK(w.station->height == 250.0);
}

TEST_CASE("NSRDB: instants in the header's zone, units of the header",
          "[thermal][weather_file][psm]") {
    const ScratchFolder folder("psm");
    const auto file = folder.path / "psm.csv";
    const std::string head =
        "Source,Location ID,City,State,Country,Latitude,Longitude,Time Zone,Elevation,Local Time "
        "Zone,Temperature Units,Pressure Units,Version\n"
        "NSRDB,401182,-,-,-,40.53,-108.54,-7,2168,-7,c,mbar,4.0.1\n";
    write_text(file, head +
                         "Year,Month,Day,Hour,Minute,Temperature,Clearsky GHI,GHI,DNI,DHI,Dew "
                         "Point,Pressure,Wind Speed,Relative Humidity,,\n"
                         "2021,7,8,12,0,20,999,800,700,100,5,782,2.5,37.5,,\n"
                         "2021,7,8,12,30,22,999,820,-9999,110,5,781,3.5,33.5,,\n"
                         "2021,7,8,13,0,24,999,840,720,120,5,780,4.5,29.5,,\n");
    CHECK(weather_format(file) == WeatherFormat::psm);
    const Weather w = read_weather(file);
    const Forcing f = w.at(instant("2021-07-08T19:30:00Z"));
    CHECK(f.shortwave_down == 820.0);
    CHECK(f.direct_normal == Approx(710.0));  // −9999: on the line between its neighbours
    CHECK(f.air.temperature == Approx(295.15));
    CHECK(f.air.pressure == Approx(78100.0));
    CHECK(f.wind_speed == 3.5);
    REQUIRE(w.station);
    CHECK(w.station->height == 2168.0);
    CHECK(w.warnings.empty());
    CHECK(has(message_of(file, head + "Year,Month,Day,Minute,GHI\n2021,7,8,0,0\n"), "NSRDB"));
}

TEST_CASE("SolarAnywhere: means that end at the stamp", "[thermal][weather_file]") {
    const ScratchFolder folder("solar_anywhere");
    const auto file = folder.path / "sa.csv";
    std::string text =
        "0,Burlington,-,-5.0,44.465,-73.205,41,Data Version: 3.6 / Type: Typical Year\n"
        "ObservationTime(LST),Global Horizontal Irradiance (GHI) W/m2,AmbientTemperature (deg C),"
        "WindSpeed (m/s),Relative Humidity (%),Clear Sky GHI\n";
    for (int hour = 1; hour < 24; ++hour) {
        text += fmt::format("12/31/2000 {:02}:00,{},-5,4,80,0\n", hour, 10 * hour);
    }
    text += "01/01/2001 00:00,0,-6,4,80,0\n";
    write_text(file, text);
    const Weather w = read_weather(
        file, {.asked = {instant("2026-12-31T12:00:00Z"), instant("2026-12-31T20:00:00Z")}});
    CHECK(w.at(instant("2026-12-31T16:30:00Z")).shortwave_down ==
          120.0);  // of 11 to 12 h, 5 h behind
    CHECK(has(w.note, "a typical year"));
}

TEST_CASE("times are in several columns, codes are missing values", "[thermal][weather_file]") {
    const ScratchFolder folder("time_parts");
    const auto file = folder.path / "parts.csv";
    const auto columns = [](std::initializer_list<std::pair<const char*, const char*>> list) {
        std::vector<DeclaredColumn> declared;
        for (const auto& [name, says] : list) declared.push_back(declared_column(name, says, "x"));
        return declared;
    };
    write_text(file, "Y,Mo,D,H,Mi,T\n2021,7,8,12,30,20\n2021,7,8,13,0,-9999\n2021,7,8,13,30,24\n");
    const Weather w = read_weather(file, {.interval = Stamp::instant,
                                          .columns = columns({{"Y", "year -07:00"},
                                                              {"Mo", "month"},
                                                              {"D", "day"},
                                                              {"H", "hour"},
                                                              {"Mi", "minute"},
                                                              {"T", "air_temperature degC"}}),
                                          .missing = {-9999.0}});
    CHECK(w.instant.front() == instant("2021-07-08T19:30:00Z"));
    CHECK(w.at(instant("2021-07-08T20:00:00Z")).air.temperature == Approx(295.15));

    write_text(file, "year,doy,hhmm,T\n2020,366,0030,20\n2020,366,2330,21\n");
    const Weather leap = read_weather(file, {.interval = Stamp::instant,
                                             .columns = columns({{"year", "year UTC"},
                                                                 {"doy", "day_of_year"},
                                                                 {"hhmm", "clock"},
                                                                 {"T", "air_temperature degC"}}),
                                             .on_gap = OnGap::interpolate});
    CHECK(leap.instant.front() == instant("2020-12-31T00:30:00Z"));

    CHECK(has(refused(file, {.columns = columns({{"year", "year"},
                                                 {"doy", "day_of_year"},
                                                 {"T", "air_temperature degC"}})}),
              "have no UTC offset"));
    CHECK(has(
        refused(file, {.columns = columns({{"year", "year UTC"}, {"T", "air_temperature degC"}})}),
        "no column for the day"));
}

// A logger's export (month first, half days) and a German one (day first), as their makers write
// them: 28 July 2021, 1:30 PM in Denver is 19:30 UTC; 13:30 in Munich is 11:30 UTC.
TEST_CASE("dates begin with the month or the day where that is declared",
          "[thermal][weather_file]") {
    const ScratchFolder folder("date_order");
    const auto file = folder.path / "logger.csv";
    const auto read = [&](const char* rows, const char* says) {
        write_text(file, std::string("Date Time,T\n") + rows);
        return read_weather(file, {.interval = Stamp::instant,
                                   .columns = {declared_column("Date Time", says, "x"),
                                               declared_column("T", "air_temperature degC", "x")}});
    };
    CHECK(read("7/28/2021 1:30 PM,30\n7/28/2021 2:00 PM,31\n", "time_mdy -06:00").instant.front() ==
          instant("2021-07-28T19:30:00Z"));
    CHECK(read("07/28/2021 12:15 AM,30\n07/28/2021 12:45:30 PM,31\n", "time_mdy UTC").instant ==
          std::vector<Instant>{instant("2021-07-28T00:15:00Z"), instant("2021-07-28T12:45:30Z")});
    CHECK(read("28.07.2021 13:30,30\n28.07.2021 14:00,31\n", "time_dmy +02:00").instant.front() ==
          instant("2021-07-28T11:30:00Z"));
    CHECK(read("2021/07/28 13:30,30\n2021/07/28 14:00,31\n", "time UTC").instant.front() ==
          instant("2021-07-28T13:30:00Z"));

    const auto problem = [&](const char* rows, const char* says) -> std::string {
        try {
            read(rows, says);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(has(problem("28.07.2021 13:30,30\n", "time UTC"), "time_dmy -07:00"));
    CHECK(has(problem("7/28/2021 13:30,30\n", "time_dmy UTC"), "2:1"));
    CHECK(has(problem("7/28/21 13:30,30\n", "time_mdy UTC"), "7/28/2021 (month, day, year)"));
    CHECK(has(problem("7/28/2021 13:30 PM,30\n", "time_mdy UTC"), "expected 1 to 12"));
}

TEST_CASE("a column that nobody reads and a far station are warned of", "[thermal][weather_file]") {
    const ScratchFolder folder("warned");
    const auto file = folder.path / "w.csv";
    write_text(file, "valid,tmpc,wind_kmh,wind_dir\n2021-07-08T12:00:00Z,20,18,90\n");
    const std::vector<DeclaredColumn> columns{declared_column("valid", "time UTC", "x"),
                                              declared_column("tmpc", "air_temperature degC", "x")};
    const Weather w = read_weather(file, {.columns = columns});
    REQUIRE(w.warnings.size() == 1);
    CHECK(has(w.warnings.front().line(), "wind_kmh"));

    const auto epw = folder.path / "far.epw";
    write_text(epw, epw_head("", 1) + epw_line(1, 0, 20.0, 330.0, 0.0));
    // One degree of latitude on a sphere of 6371 km is 111.2 km.
    const Weather far = read_weather(epw, {.elevation = 250.0, .site = Site{46.0, 8.0, 0.0}});
    REQUIRE(far.warnings.size() == 1);
    CHECK(has(far.warnings.front().line(), "111 km"));
    const Weather high = read_weather(epw, {.elevation = 851.0, .site = Site{45.0, 8.0, 0.0}});
    REQUIRE(high.warnings.size() == 1);
    CHECK(has(high.warnings.front().line(), "601 m lower"));
    CHECK(read_weather(epw, {.elevation = 449.0, .site = Site{45.3, 8.0, 0.0}}).warnings.empty());
}

TEST_CASE("days in several files are one series, in any order", "[thermal][weather_file]") {
    const ScratchFolder folder("joined");
    const auto day = [&](const char* name, int d) {
        std::string text = "time,air_temperature_K\n";
        for (int hour = 0; hour < 24; ++hour) {
            text += fmt::format("2021-07-{:02}T{:02}:00:00Z,{}\n", d, hour, 280 + d + hour / 24.0);
        }
        write_text(folder.path / name, text);
        return folder.path / name;
    };
    const std::vector<std::filesystem::path> files{day("b.csv", 9), day("a.csv", 8)};
    const Weather w = read_weather(files, {.interval = Stamp::instant});
    CHECK(w.instant.size() == 48);
    CHECK(w.at(instant("2021-07-08T23:30:00Z")).air.temperature ==
          Approx(280.0 + 8.0 + 23.5 / 24.0));
    const auto epw = folder.path / "other.epw";
    write_text(epw, epw_head("", 1) + epw_line(1, 0, 20.0, 330.0, 0.0));
    CHECK_THROWS_WITH(read_weather(std::vector<std::filesystem::path>{files[0], epw}),
                      Catch::Contains("the same format"));
}
