#include <catch2/catch.hpp>

#include "tests/corpus/run_corpus.hpp"

namespace {

using corpus::changed;
using corpus::Family;
using corpus::Malformed;

Malformed weather(const std::string& name, const std::string& text) {
    return {.name = name, .files = {{"weather.csv", text}}};
}

/// A cell of noon that is something else; columns as in the yard's head.
Malformed cell(int column, const std::string& what) {
    return weather(fmt::format("column {} is '{}'", column, what), yard::weather(12, column, what));
}

Family cells() {
    Family cases;
    const std::vector<std::vector<std::string>> wrong = {
        {"", "yesterday", "2026-06-20", "2026-06-20T25:00:00Z", "2026-06-31T00:00:00Z",
         "2026-06-20T12:00:00", "99999-06-20T12:00:00Z", "1e9", "2026-06-20T11:00:00Z",
         "2026-06-20T10:00:00Z", "20.06.2026 12:00"},
        {"999", "800", "401", "99", "0", "-40", "20", "-273.15", "285,5", "n.a.", "inf", "-inf",
         "1e308", "285 K", "0x11d", "+-", "1e999"},
        {"50", "-0.1", "n.a.", "95", "1.5", "x"},
        {"1013", "0", "-100000", "1e6", "99999999", "n.a."},
        {"-1", "500", "n.a.", "3 m/s", "1e30"},
        {"-500", "9999", "n.a.", "inf", "1e10"},
        {"-500", "9999", "n.a."},
        {"-1", "5000", "n.a.", "inf"},
    };
    for (std::size_t column = 0; column < wrong.size(); ++column) {
        for (const std::string& what : wrong[column]) cases.push_back(cell(int(column), what));
    }
    return cases;
}

std::string replaced(std::string text, char from, char to) {
    std::replace(text.begin(), text.end(), from, to);
    return text;
}

Family files() {
    const std::string head = yard::weather_head, fine = yard::weather();
    std::string disordered = head, wide = "time,air_temperature_K",
                row_wide = "2026-06-20T00:00:00Z,280";
    for (int h = 24; h > 12; --h) disordered += yard::weather_row(h);
    for (int h = 0; h <= 12; ++h) disordered += yard::weather_row(h);
    for (int i = 0; i < 1000000; ++i) wide += ",c", row_wide += ",1";
    std::string twelve = head;
    for (int h = 0; h <= 12; ++h) twelve += yard::weather_row(h);
    std::string repeated = fine + yard::weather_row(24);
    std::string double_column = changed(head, "wind_speed_m_s", "air_temperature_K");
    std::string years = head;
    return {
        weather("nothing", ""),
        weather("the head alone", head),
        weather("a row alone", head + yard::weather_row(0)),
        weather("no head", fine.substr(head.size())),
        weather("decimal commas", changed(fine, "0.5", "0,5")),
        weather("half a day", twelve),
        weather("times in disorder", disordered),
        weather("a time twice", repeated),
        weather("a short row", changed(fine, "100000,3,", "3,")),
        weather("a long row", changed(fine, "100000,3,", "100000,3,3,")),
        weather("a column twice", changed(fine, "wind_speed_m_s", "air_temperature_K")),
        weather("time twice", changed(fine, "wind_speed_m_s", "time")),
        weather("an unknown column", changed(fine, "wind_speed_m_s", "wind")),
        weather("no temperature", changed(fine, "air_temperature_K", "air_temperature_C")),
        weather("no time", changed(fine, "time", "date")),
        weather("HTML", "<!DOCTYPE html><html><body>Not found</body></html>\n"),
        weather("a spreadsheet's archive",
                std::string("PK\x03\x04\0\0\0\0\x08\0", 10) + std::string(3000, '\x7f')),
        weather("NULs", std::string(4000, '\0')),
        weather("UTF-16", std::string("\xff\xfet\0i\0m\0e\0", 10)),
        weather("a head of a million columns", wide + "\n" + row_wide + "\n"),
        weather("ten million columns",
                "time,air_temperature_K" + std::string(10000000, ',') + "\n"),
        weather("60 MB of commas", head + std::string(60000000, ',') + "\n"),
        weather("one line of 60 MB", std::string(60000000, 'x')),
        weather("an unclosed quote", changed(fine, "0.5", "\"0.5")),
        weather("a year before", replaced(fine, '6', '5')),
        weather("EPW's name and no more", "LOCATION,x\n"),
        weather("EPW without weather", "LOCATION,a,b,c,d,e,47,9,1,100\nD\nT\nG\nH\nC\nC\nD\n"),
        weather("EPW of text",
                "LOCATION,a,b,c,d,e,x,9,1,100\nD\nT\nG\nH\nC\nC\nD\n2026,6,20,1,0\n"),
        weather("EPW with short rows",
                "LOCATION,a,b,c,d,e,47,9,1,100\nD\nT\nG\nH\nC\nC\nD\n2026,6,20,1,0,x,20\n"),
        weather("EPW at 999 degrees",
                "LOCATION,a,b,c,d,e,47,9,1,100\nD\nT\nG\nH\nC\nC\nD\n2026,6,20,1,0,x,999,10,50,"
                "100000,0,0,300,0,0,0,0,0,0,0,180,3,0,0,0,0,0,0,0,0,0,0,0,0,0\n"),
        weather("EPW in latitude 470",
                "LOCATION,a,b,c,d,e,470,9,1,100\nD\nT\nG\nH\nC\nC\nD\n"
                "2026,6,20,1,0,x,20,10,50,100000,0,0,300,0,0,0,0,0,0,0,180,3,0,0,0,0,0,0,0,0,0,0,0,"
                "0,0\n"),
        weather("EPW in month 13",
                "LOCATION,a,b,c,d,e,47,9,1,100\nD\nT\nG\nH\nC\nC\nD\n"
                "2026,13,20,1,0,x,20,10,50,100000,0,0,300,0,0,0,0,0,0,0,180,3,0,0,0,0,0,0,0,0,0,0,"
                "0,0,0\n"),
        weather("EPW with a year of 1e300",
                "LOCATION,a,b,c,d,e,47,9,1,100\nD\nT\nG\nH\nC\nC\nD\n"
                "1e300,1,20,1,0,x,20,10,50,100000,0,0,300,0,0,0,0,0,0,0,180,3,0,0,0,0,0,0,0,0,0,0,"
                "0,0,0\n"),
        weather("EPW with an offset of 1e9",
                "LOCATION,a,b,c,d,e,47,9,1e9,100\nD\nT\nG\nH\nC\nC\nD\n"
                "2026,1,20,1,0,x,20,10,50,100000,0,0,300,0,0,0,0,0,0,0,180,3,0,0,0,0,0,0,0,0,0,0,0,"
                "0,0\n"),
        weather("ERA5 in degrees Celsius",
                "valid_time,t2m,latitude,longitude\n2026-06-20 00:00:00,12,47,9\n"
                "2026-06-20 01:00:00,12,47,9\n"),
        weather("ERA5 of two places",
                "valid_time,t2m,latitude,longitude\n2026-06-20 00:00:00,282,47,9\n"
                "2026-06-20 01:00:00,282,48,9\n"),
        weather("ERA5 of text", "valid_time,t2m,latitude,longitude\n2026-06-20 00:00:00,x,47,9\n"),
        weather("ERA5 with a column twice",
                "valid_time,t2m,t2m,latitude,longitude\n2026-06-20 00:00:00,282,290,47,9\n"
                "2026-06-22 00:00:00,282,290,47,9\n"),
        weather("half a netCDF", std::string("CDF\x01\0\0\0\0\0\0\0\x0a", 12)),
        weather("a netCDF that claims much",
                std::string("CDF\x01\x7f\xff\xff\xff\0\0\0\x0a\x7f\xff\xff\xff", 16)),
        weather("half an HDF5",
                std::string("\x89HDF\r\n\x1a\n\x02\x08\x08\0", 12) + std::string(36, '\xff')),
        weather("SURFRAD's head alone", " Bondville\n  40.05 -88.37 213 m version 1\n"),
        weather("SURFRAD with short rows",
                " Bondville\n  40.05 -88.37 213 m version 1\n 2026 171 6 20 0 0 0.0 90\n"),
        weather("BSRN without measurements", "*C0001\n 21 6 2026 1\n*C0004\n"),
        weather("BSRN with half a minute", "*C0001\n 21 6 2026 1\n*C0100\n 1 0 5 1 1 1 5 1 1 1\n"),
    };
}

/// The keys of [weather] that meet a file.
Family keys() {
    const auto with = [](const std::string& name, const std::string& more,
                         const std::string& text) {
        return Malformed{.name = name,
                         .files = {{"scene.toml", changed(yard::scene, "file = \"weather.csv\"\n",
                                                          "file = \"weather.csv\"\n" + more)},
                                   {"weather.csv", text}}};
    };
    const std::string foreign = changed(yard::weather(), "air_temperature_K", "T");
    return {
        with("a declared column that is not there", "columns = { X = \"air_temperature K\" }\n",
             yard::weather()),
        with("a declared unit that is none", "columns = { T = \"air_temperature furlong\" }\n",
             foreign),
        with("Kelvin declared as Celsius", "columns = { T = \"air_temperature degC\" }\n", foreign),
        with("Kelvin declared as Fahrenheit", "columns = { T = \"air_temperature degF\" }\n",
             foreign),
        with("two columns of one quantity",
             "columns = { T = \"air_temperature K\", relative_humidity = \"air_temperature K\" }\n",
             foreign),
        with("a unit of another quantity", "columns = { T = \"air_temperature m/s\" }\n", foreign),
        with("wind at 1 km", "wind_height_m = 1000.0\n", yard::weather()),
        with("a height on the moon", "height_m = 384000000.0\n", yard::weather()),
    };
}

}  // namespace

TEST_CASE("weather whose cells cannot be is refused") { corpus::no_fault("cells", cells()); }

TEST_CASE("the point tool refuses the same cells") {
    Family cases = cells();
    for (Malformed& given : cases) given.words = {"column", "column.toml"};
    corpus::no_fault("point cells", cases);
}

TEST_CASE("files that are no weather files are refused") { corpus::no_fault("weather", files()); }

TEST_CASE("weather that is not as its scene says is refused") {
    corpus::no_fault("weather keys", keys());
}
