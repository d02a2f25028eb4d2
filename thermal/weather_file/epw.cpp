#include "thermal/weather_file/epw.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/epw_times.hpp"
#include "thermal/weather_file/text_lines.hpp"

namespace diurna {

namespace {

constexpr std::size_t header_lines = 8;

/// A column that becomes a quantity unchanged: where it is, its code for missing, its unit.
struct EpwColumn {
    std::size_t column;
    double missing;
    Quantity quantity;
    double factor = 1.0, offset = 0.0;
};
// Energies of an hour [Wh m⁻²] are mean fluxes; those of shorter intervals EnergyPlus takes for
// such.
constexpr std::array<EpwColumn, 9> epw_columns{{
    {6, 99.9, Quantity::air_temperature, 1.0, zero_celsius},
    {7, 99.9, Quantity::dew_point, 1.0, zero_celsius},
    {8, 999.0, Quantity::relative_humidity, 0.01},
    {9, 999999.0, Quantity::pressure},
    {12, 9999.0, Quantity::longwave_down},
    {13, 9999.0, Quantity::shortwave_down},
    {14, 9999.0, Quantity::direct_normal},
    {15, 9999.0, Quantity::diffuse},
    {21, 999.0, Quantity::wind_speed},
}};
constexpr std::size_t total_cover = 22, opaque_cover = 23, rain_depth = 33, rain_hours = 34;

/// Values that are zero where files have none: no sky above air sends nothing, no ground has no
/// pressure.
struct Zeros {
    long long infrared = 0, pressure = 0;
};

/// NaN for such a zero, which is counted.
double unless_zero(Quantity quantity, double value, Zeros& zeros) {
    if (!(value <= 0.0)) return value;
    if (quantity == Quantity::longwave_down) {
        ++zeros.infrared;
        return not_measured;
    }
    if (quantity == Quantity::pressure) {
        ++zeros.pressure;
        return not_measured;
    }
    return value;
}

/// Hours from a row's hour to the instant of its sunlight, which PVGIS writes into a comment:
/// "COMMENTS 2,Irradiance Time Offset (h):-0.8239" (JRC, PVGIS user manual). None: the sunlight is
/// of the row's hour.
std::optional<double> irradiance_offset(const TextLines& lines) {
    for (std::size_t i = 0; i < header_lines; ++i) {
        const std::string line = small_letters(lines.line[i]);
        const std::size_t at = line.find("irradiance time offset");
        if (at == std::string::npos) continue;
        const std::size_t colon = line.find_first_of(":=", at);
        if (colon == std::string::npos) continue;
        std::string_view number = std::string_view(line).substr(colon + 1);
        number = number.substr(0, number.find_first_of(",;\""));
        const auto words = words_of(number);
        const std::string where = lines.where(i);
        const double hours = number_in(words.empty() ? "" : words.front(), where);
        check_within(where + ": irradiance time offset [h]", hours, -24.0, 24.0);
        return hours;
    }
    return std::nullopt;
}

/// A line's numbers; columns that are not there are NaN.
double cell(const std::vector<std::string>& cells, std::size_t column, const std::string& where) {
    if (column >= cells.size() || cells[column].empty()) return not_measured;
    return number_in(cells[column], fmt::format("{}:{}", where, column + 1));
}

void put_epw(const std::vector<std::string>& cells, const std::string& where, WeatherTable& table,
             Zeros& zeros) {
    for (const EpwColumn& c : epw_columns) {
        const double value =
            unless_zero(c.quantity, unless_missing(cell(cells, c.column, where), c.missing), zeros);
        put(table, c.quantity, c.factor * value + c.offset,
            fmt::format("{}:{}", where, c.column + 1));
    }
    double cover = unless_missing(cell(cells, opaque_cover, where), 99.0);
    if (std::isnan(cover)) cover = unless_missing(cell(cells, total_cover, where), 99.0);
    put(table, Quantity::cloud_fraction, 0.1 * cover,
        fmt::format("{}:{}", where, opaque_cover + 1));
    // Rain fell over so many hours; most files do not say, then over the row's own.
    const double depth = unless_missing(cell(cells, rain_depth, where), 999.0);
    double hours = unless_missing(cell(cells, rain_hours, where), 99.0);
    if (std::isnan(hours) || hours <= 0.0) hours = 1.0;
    put(table, Quantity::rain, depth / hours, fmt::format("{}:{}", where, rain_depth + 1));
}

}  // namespace

WeatherTable read_epw(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    if (lines.line.size() <= header_lines || !lines.line[0].starts_with("LOCATION,")) {
        throw InputError(lines.where(0), "is not EPW: expected LOCATION and 7 more header lines");
    }
    WeatherTable table{.file = file, .format = "EPW"};
    table.stamps = Stamp::end;
    table.states_at_stamp = true;
    const std::vector<std::string> place = csv_cells(lines.line[0]);
    if (place.size() < 10) {
        throw InputError(lines.where(0), fmt::format("found {} cells, expected 10", place.size()));
    }
    const auto of_place = [&](std::size_t i) {
        return number_in(place[i], fmt::format("{}:{}", lines.where(0), i + 1));
    };
    table.place = {of_place(6), of_place(7), of_place(9)};
    const double zone_h = of_place(8);
    // PVGIS writes its rows in UTC whatever the header's zone: hour 1 is the instant 00:00. Its own
    // CSV of the same place has the same rows at these instants.
    const std::optional<double> light_h = irradiance_offset(lines);
    const double offset_h = light_h ? 0.0 : zone_h;
    std::vector<EpwTime> times;
    std::vector<std::string> places;
    std::vector<std::vector<std::string>> cells;
    for (std::size_t i = header_lines; i < lines.line.size(); ++i) {
        if (lines.line[i].find_first_not_of(" ,\t") == std::string_view::npos) continue;
        const std::string where = lines.where(i);
        std::vector<std::string> row = csv_cells(lines.line[i]);
        if (row.size() < 22) {
            throw InputError(where, fmt::format("found {} cells, expected 35", row.size()));
        }
        std::array<int, 5> time{};
        for (std::size_t k = 0; k < 5; ++k) {
            time[k] = int(std::lround(number_in(row[k], fmt::format("{}:{}", where, k + 1))));
        }
        times.push_back({time[0], time[1], time[2], time[3], time[4]});
        places.push_back(where);
        cells.push_back(std::move(row));
    }
    if (times.empty()) throw InputError(file.string(), "has no weather, only a header");
    const std::vector<double> ends =
        epw_ends(times, epw_rows_per_hour(lines.line[header_lines - 1]), table.notes);
    std::vector<LocalRow> rows;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double stamp = light_h ? ends[i] - 3600.0 : ends[i];
        rows.push_back({times[i].year, times[i].month, times[i].day, stamp, places[i]});
    }
    Zeros zeros;
    add_local_rows(rows, offset_h, asked, table,
                   [&](std::size_t i) { put_epw(cells[i], rows[i].where, table, zeros); });
    for (const auto& [count, what] : {std::pair{zeros.infrared, "infrared of 0 W/m2"},
                                      std::pair{zeros.pressure, "pressure of 0 Pa"}}) {
        if (count == 0) continue;
        table.notes.push_back(
            fmt::format("{} in {} is treated as missing", what, number_of(count, "row")));
    }
    if (light_h) {
        const double after_h = *light_h + 1.0;
        table.stamps = Stamp::instant;
        table.light_offset = 3600.0 * after_h;
        table.notes.push_back(fmt::format(
            "EPW of PVGIS: hour 1 is the instant 00:00 UTC{}; sunlight is that of {:.0f} min {}",
            zone_h == 0.0 ? ""
                          : fmt::format(" (the time zone {:g} of its header is not used)", zone_h),
            std::abs(60.0 * after_h), after_h < 0.0 ? "before" : "after"));
    }
    return table;
}

}  // namespace diurna
