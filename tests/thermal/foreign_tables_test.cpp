#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/weather_file/foreign_columns.hpp"
#include "thermal/weather_file/read_weather.hpp"
#include "thermal/weather_file/separators.hpp"

// Tables of weather with other separators and names than the program's.

using namespace diurna;

namespace {

/// Three hours of 20, 21.5 and 23 degC, 50 % and 3.6 km/h = 1 m/s, with this header and separator.
std::string rows(const std::string& header, const std::string& stamp_end, char separator,
                 char decimal = '.') {
    std::string text = header + "\n";
    for (const auto& [hour, celsius] : {std::pair{"12", "20.0"}, {"13", "21.5"}, {"14", "23.0"}}) {
        text += std::string("2026-07-15T") + hour + ":00:00" + stamp_end + separator + celsius +
                separator + "50.0" + separator + "3.6\n";
    }
    if (decimal != '.') {
        for (char& c : text) c = c == '.' ? decimal : c;
    }
    return text;
}

void check_weather(const std::string& text, const std::string& name = "foreign.csv") {
    const ScratchFolder folder("foreign_tables");
    write_text(folder.path / name, text);
    CAPTURE(text);
    WeatherOptions options;
    options.columns = declared_columns(recognised_columns_of(folder.path / name));
    const WeatherTable table = read_weather_table(folder.path / name, options);
    REQUIRE(table.stamp.size() == 3);
    CHECK(table.stamp[0] == parse_instant("2026-07-15T12:00:00Z"));
    REQUIRE(table.has(Quantity::air_temperature));
    CHECK(table.of(Quantity::air_temperature)[1] == Approx(273.15 + 21.5).epsilon(1e-12));
    REQUIRE(table.has(Quantity::relative_humidity));
    CHECK(table.of(Quantity::relative_humidity)[2] == Approx(0.5));
    REQUIRE(table.has(Quantity::wind_speed));
    CHECK(table.of(Quantity::wind_speed)[0] == Approx(1.0).epsilon(1e-9));
}

std::string refused(const std::string& text) {
    const ScratchFolder folder("refused_tables");
    write_text(folder.path / "foreign.csv", text);
    try {
        WeatherOptions options;
        options.columns = declared_columns(recognised_columns_of(folder.path / "foreign.csv"));
        read_weather_table(folder.path / "foreign.csv", options);
    } catch (const InputError& error) {
        return error.mistakes().size() == 1 ? error.mistakes()[0].line() : "several lines";
    }
    return "none";
}

}  // namespace

TEST_CASE("tables with semicolons, tabs or blanks and decimal commas are read as with commas",
          "[thermal][foreign_tables]") {
    const auto header = [](const std::string& mark) {
        return "time" + mark + "Temp_degC" + mark + "RH_%" + mark + "wind_km/h";
    };
    check_weather(rows(header(","), "Z", ','));
    check_weather(rows(header(";"), "Z", ';'));
    check_weather(rows(header(";"), "Z", ';', ','));
    check_weather(rows(header("\t"), "Z", '\t'));
    check_weather(rows(header("\t"), "Z", '\t', ','));
    check_weather(rows(header(" "), "Z", ' '));
    check_weather(rows(header("   "), "Z", ' '), "station.txt");
    // What has commas is left as it is, whatever else it has.
    std::string found;
    const std::string own = "time,air_temperature_K\n2026-07-15T12:00:00Z,290;1\n";
    CHECK(with_commas(own, 0, found) == own);
    CHECK(found.empty());
    CHECK(with_commas("a;b\n\"x;y\";1,5\nu,v;2\n", 0, found) == "a,b\n\"x;y\",1.5\n\"u,v\",2\n");
    CHECK(found == "';'");
    // Words of a header that are not as many as the cells of a row separate nothing.
    CHECK(with_commas("air temperature\n290\n", 0, found) == "air temperature\n290\n");
}

TEST_CASE("columns are recognised by usual names with their units", "[thermal][foreign_tables]") {
    for (const char* header : {
             "time_utc,Temp (°C),RH (%),Wind speed (km/h)",
             "Date Time [UTC],Air Temperature [deg C],Relative Humidity [%],WS [km h-1]",
             "timestamp,T2m_C,humidity %,wind_speed_10m (km/h)",
             "datetime,air_temperature_degC,relative_humidity_percent,WindSpeed kph",
         }) {
        CAPTURE(header);
        check_weather(rows(header, "Z", ','));
    }
    // UTC from the name alone, and of a stamp with a blank.
    std::string text = rows("Time (UTC);T [°C];rh [%];ff [km/h]", "", ';');
    for (std::size_t at = text.find("15T"); at != text.npos; at = text.find("15T"))
        text[at + 2] = ' ';
    check_weather(text);
    // Other temperatures and wind directions are not those of the air and its speed.
    const CsvTable table =
        csv_table("x.csv",
                  "time,soil temperature (C),T_surface (C),wind direction (deg),gust (m/s)\n"
                  "2026-07-15T12:00:00Z,1,2,3,4\n");
    CHECK(recognised_columns(table).size() == 1);
}

TEST_CASE("a table that is not readable gets one line with what is found, expected and recognised",
          "[thermal][foreign_tables]") {
    // The offset of its times and the unit of its temperature are unknown.
    const std::string line = refused(rows("date,Temp,RH (%),wind (km/h)", "", ','));
    CAPTURE(line);
    for (const char* part :
         {"foreign.csv:1: ", "found the columns 'date', 'Temp', 'RH (%)', 'wind (km/h)'",
          "expected time, air_temperature_K", "[weather.columns]", "date = \"time UTC-OFFSET\"",
          "Temp = \"air_temperature UNIT\"", "'RH (%)' = \"relative_humidity %\"",
          "'wind (km/h)' = \"wind_speed km/h\""}) {
        CAPTURE(part);
        CHECK(line.find(part) != std::string::npos);
    }
    const std::string none = refused("a,b\n1,2\n");
    CAPTURE(none);
    CHECK(none.find("found the columns 'a', 'b'") != std::string::npos);
    CHECK(none.find("\"air_temperature degC\"") != std::string::npos);
}
