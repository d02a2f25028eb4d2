#include "thermal/weather_file/tmy3.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/text_lines.hpp"
#include "thermal/weather_file/weather_text.hpp"

namespace diurna {

namespace {

struct Tmy3Column {
    const char* name;
    Quantity quantity;
    double factor = 1.0, offset = 0.0;
};
constexpr std::array<Tmy3Column, 9> tmy3_columns{{
    {"GHI (W/m^2)", Quantity::shortwave_down},
    {"DNI (W/m^2)", Quantity::direct_normal},
    {"DHI (W/m^2)", Quantity::diffuse},
    {"OpqCld (tenths)", Quantity::cloud_fraction, 0.1},
    {"Dry-bulb (C)", Quantity::air_temperature, 1.0, zero_celsius},
    {"Dew-point (C)", Quantity::dew_point, 1.0, zero_celsius},
    {"RHum (%)", Quantity::relative_humidity, 0.01},
    {"Pressure (mbar)", Quantity::pressure, 100.0},
    {"Wspd (m/s)", Quantity::wind_speed},
}};

double cell(const CsvTable& csv, std::size_t row, std::size_t column) {
    if (csv.rows[row][column].empty()) return not_measured;
    const double value = csv.number(row, column);
    return value <= -9900.0 ? not_measured : value;
}

/// Row `row` of the file, the last of the table.
void put_tmy3(const CsvTable& csv, std::size_t row, WeatherTable& table) {
    for (const Tmy3Column& c : tmy3_columns) {
        if (!csv.has(c.name)) continue;
        const std::size_t column = csv.column(c.name);
        put(table, c.quantity, c.factor * cell(csv, row, column) + c.offset,
            csv.where(row, column));
    }
    if (!csv.has("Lprecip depth (mm)") || !csv.has("Lprecip quantity (hr)")) return;
    const std::size_t depth = csv.column("Lprecip depth (mm)");
    const double hours = cell(csv, row, csv.column("Lprecip quantity (hr)"));
    put(table, Quantity::rain, cell(csv, row, depth) / (hours > 0.0 ? hours : 1.0),
        csv.where(row, depth));
}

LocalRow local_row(const CsvTable& csv, std::size_t row, std::size_t date, std::size_t time) {
    LocalRow local;
    int hour = 0, minute = 0;
    local.where = csv.where(row, date);
    if (std::sscanf(csv.rows[row][date].c_str(), "%d/%d/%d", &local.month, &local.day,
                    &local.year) != 3 ||
        std::sscanf(csv.rows[row][time].c_str(), "%d:%d", &hour, &minute) != 2) {
        throw InputError(local.where, fmt::format("found '{}' '{}', expected MM/DD/YYYY HH:MM",
                                                  csv.rows[row][date], csv.rows[row][time]));
    }
    local.seconds = 3600.0 * hour + 60.0 * minute;
    return local;
}

}  // namespace

WeatherTable read_tmy3(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    const std::vector<std::string> place = csv_cells(lines.line.front());
    if (place.size() < 7) {
        throw InputError(lines.where(0), fmt::format("found {} cells, expected 7", place.size()));
    }
    const auto of_place = [&](std::size_t i) {
        return number_in(place[i], fmt::format("{}:{}", lines.where(0), i + 1));
    };
    const CsvTable csv = csv_table(file, weather_text(file), 1);
    WeatherTable table{.file = file, .format = "TMY3"};
    table.stamps = Stamp::end;
    table.states_at_stamp = true;
    table.place = {of_place(4), of_place(5), of_place(6)};
    const std::size_t date = csv.column("Date (MM/DD/YYYY)"), time = csv.column("Time (HH:MM)");
    std::vector<LocalRow> rows;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        rows.push_back(local_row(csv, row, date, time));
    }
    if (rows.empty()) throw InputError(file.string(), "has no weather, only a header");
    add_local_rows(rows, of_place(3), asked, table,
                   [&](std::size_t i) { put_tmy3(csv, i, table); });
    return table;
}

}  // namespace diurna
