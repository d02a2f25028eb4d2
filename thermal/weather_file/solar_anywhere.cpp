#include "thermal/weather_file/solar_anywhere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/text_lines.hpp"
#include "thermal/weather_file/weather_text.hpp"

namespace diurna {

namespace {

struct SolarAnywhereColumn {
    const char* name;
    Quantity quantity;
    double factor = 1.0, offset = 0.0;
};
constexpr std::array<SolarAnywhereColumn, 7> solar_anywhere_columns{{
    {"Global Horizontal Irradiance (GHI) W/m2", Quantity::shortwave_down},
    {"Direct Normal Irradiance (DNI) W/m2", Quantity::direct_normal},
    {"Diffuse Horizontal Irradiance (DIF) W/m2", Quantity::diffuse},
    {"AmbientTemperature (deg C)", Quantity::air_temperature, 1.0, zero_celsius},
    {"DewPoint (deg C)", Quantity::dew_point, 1.0, zero_celsius},
    {"Relative Humidity (%)", Quantity::relative_humidity, 0.01},
    {"WindSpeed (m/s)", Quantity::wind_speed},
}};
/// Of the interval: 1 kg m⁻² of water is 1 mm.
constexpr const char* liquid_rain = "Liquid Precipitation (kg/m2)";
constexpr const char *local_time = "ObservationTime(LST)", *utc_time = "ObservationTime(GMT)";

LocalRow solar_anywhere_row(const std::string& text, const std::string& where) {
    LocalRow row;
    int hour = 0, minute = 0, taken = 0;
    row.where = where;
    if (std::sscanf(text.c_str(), "%d/%d/%d %d:%d%n", &row.month, &row.day, &row.year, &hour,
                    &minute, &taken) != 5 ||
        taken != int(text.size())) {
        throw InputError(where,
                         fmt::format("found '{}', expected MM/DD/YYYY HH:MM", text.substr(0, 40)));
    }
    row.seconds = 3600.0 * hour + 60.0 * minute;
    if (row.seconds > 0.0) return row;
    // The end of a day's last interval: a typical year has no next one.
    const std::chrono::year_month_day date{std::chrono::year(row.year),
                                           std::chrono::month(unsigned(row.month)),
                                           std::chrono::day(unsigned(row.day))};
    if (!date.ok()) return row;
    const std::chrono::year_month_day before(std::chrono::sys_days(date) - std::chrono::days(1));
    return {.year = int(before.year()),
            .month = int(unsigned(before.month())),
            .day = int(unsigned(before.day())),
            .seconds = 86400.0,
            .where = where};
}

}  // namespace

WeatherTable read_solar_anywhere(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    const std::vector<std::string> place = csv_cells(lines.line.front());
    if (place.size() < 7) {
        throw InputError(lines.where(0), fmt::format("found {} cells, expected 7: number, name, "
                                                     "state, time zone, latitude, longitude, "
                                                     "elevation",
                                                     place.size()));
    }
    const auto of_place = [&](std::size_t i) {
        return number_in(place[i], fmt::format("{}:{}", lines.where(0), i + 1));
    };
    const CsvTable csv = csv_table(file, weather_text(file), 1);
    WeatherTable table{.file = file, .format = "SolarAnywhere"};
    table.stamps = Stamp::end;
    table.place = {of_place(4), of_place(5), of_place(6)};
    const bool local = csv.has(local_time);
    const std::size_t time = csv.column(local ? local_time : utc_time);
    std::vector<LocalRow> rows;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        rows.push_back(solar_anywhere_row(csv.rows[row][time], csv.where(row, time)));
    }
    if (rows.empty()) throw InputError(file.string(), "has no weather, only a header");
    // Of the day's hours, so that years that a typical year joins do not count.
    std::vector<double> steps;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double step = rows[i].seconds - rows[i - 1].seconds;
        if (step > 0.0) steps.push_back(step);
    }
    std::sort(steps.begin(), steps.end());
    const double interval_h = steps.empty() ? 0.0 : steps[steps.size() / 2] / 3600.0;
    const bool typical = small_letters(lines.line.front()).find("typical") != std::string::npos;
    add_local_rows(
        rows, local ? of_place(3) : 0.0, asked, table,
        [&](std::size_t i) {
            for (const SolarAnywhereColumn& c : solar_anywhere_columns) {
                if (!csv.has(c.name)) continue;
                const std::size_t column = csv.column(c.name);
                const bool empty = csv.rows[i][column].empty() || csv.rows[i][column] == "NaN";
                const double value = empty ? not_measured : csv.number(i, column);
                put(table, c.quantity, value <= -999.0 ? not_measured : c.factor * value + c.offset,
                    csv.where(i, column));
            }
            if (!csv.has(liquid_rain) || !(interval_h > 0.0)) return;
            const std::size_t column = csv.column(liquid_rain);
            const bool empty = csv.rows[i][column].empty() || csv.rows[i][column] == "NaN";
            const double value = empty ? not_measured : csv.number(i, column);
            put(table, Quantity::rain, value <= -999.0 ? not_measured : value / interval_h,
                csv.where(i, column));
        },
        typical);
    for (const std::string& name : csv.header) {
        const bool used = std::any_of(solar_anywhere_columns.begin(), solar_anywhere_columns.end(),
                                      [&](const auto& c) { return name == c.name; }) ||
                          name == liquid_rain;
        if (!used && !name.empty()) table.unused.push_back(name);
    }
    return table;
}

}  // namespace diurna
