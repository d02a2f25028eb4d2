#include "thermal/weather_file/psm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "thermal/weather_file/text_lines.hpp"

namespace diurna {

namespace {

constexpr std::size_t psm_header_lines = 3;
constexpr double psm_missing = -999.0;  // and below

/// A quantity's columns by their names, its unit where the header names none.
struct PsmColumn {
    Quantity quantity;
    std::array<const char*, 2> name;  // NSRDB's, SAM's
    const char* unit;
};
constexpr std::array<PsmColumn, 8> psm_columns{{
    {Quantity::shortwave_down, {"ghi", "gh"}, "W/m2"},
    {Quantity::direct_normal, {"dni", "dn"}, "W/m2"},
    {Quantity::diffuse, {"dhi", "df"}, "W/m2"},
    {Quantity::air_temperature, {"temperature", "tdry"}, "degC"},
    {Quantity::dew_point, {"dew point", "tdew"}, "degC"},
    {Quantity::relative_humidity, {"relative humidity", "rh"}, "%"},
    {Quantity::pressure, {"pressure", "pres"}, "mbar"},
    {Quantity::wind_speed, {"wind speed", "wspd"}, "m/s"},
}};
constexpr std::array<const char*, 5> psm_times{"year", "month", "day", "hour", "minute"};

/// A line's cells in small letters.
std::vector<std::string> small_cells(std::string_view line) {
    std::vector<std::string> cells = csv_cells(line);
    for (std::string& cell : cells) cell = small_letters(cell);
    return cells;
}

std::optional<std::size_t> place_of_name(const std::vector<std::string>& names,
                                         std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

/// The two lines of the header: names and values.
struct PsmHeader {
    std::vector<std::string> name, value;
    std::string where;  // of the values

    double number(const char* key) const {
        const auto at = place_of_name(name, key);
        if (!at || *at >= value.size()) {
            throw InputError(where, fmt::format("no '{}' in the header of an NSRDB file", key));
        }
        return number_in(value[*at], fmt::format("{}:{}: {}", where, *at + 1, key));
    }
    /// By a column's name: "pressure units" of "pressure".
    Unit unit(const PsmColumn& column, const std::string& named) const {
        const auto at = place_of_name(name, named + " units");
        std::string word = at && *at < value.size() ? value[*at] : "";
        for (const auto& [theirs, ours] : {std::pair{"w/m2", "W/m2"},
                                           {"w/m^2", "W/m2"},
                                           {"c", "degC"},
                                           {"celsius", "degC"},
                                           {"k", "K"},
                                           {"pa", "Pa"},
                                           {"hpa", "hPa"},
                                           {"millibar", "mbar"},
                                           {"n/a", ""}}) {
            if (word == theirs) word = ours;
        }
        const auto found = unit_named(column.quantity, word.empty() ? column.unit : word);
        if (!found) {
            throw InputError(fmt::format("{}: {} units", where, named),
                             fmt::format("found '{}' in the header of an NSRDB file, expected one "
                                         "of {}",
                                         word, fmt::join(unit_names(column.quantity), ", ")));
        }
        return *found;
    }
};

struct PsmUsed {
    std::size_t column;
    Quantity quantity;
    Unit unit;
};

}  // namespace

WeatherTable read_psm(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    if (lines.line.size() <= psm_header_lines) {
        throw InputError(
            file.string(),
            "is truncated: an NSRDB file has two header lines, one line of columns and then rows");
    }
    const PsmHeader header{small_cells(lines.line[0]), small_cells(lines.line[1]), lines.where(1)};
    const std::vector<std::string> names = small_cells(lines.line[2]);
    WeatherTable table{.file = file, .format = "NSRDB"};
    table.stamps = Stamp::instant;
    table.place = {header.number("latitude"), header.number("longitude"),
                   header.number("elevation")};
    std::array<std::optional<std::size_t>, 5> time{};
    for (std::size_t k = 0; k < psm_times.size(); ++k) {
        time[k] = place_of_name(names, psm_times[k]);
        if (!time[k] && k < 4) {
            throw InputError(lines.where(2),
                             fmt::format("no column '{}' in an NSRDB file", psm_times[k]));
        }
    }
    // SAM takes hourly rows without a minute as those of the middle of the hour (NREL/ssc,
    // shared/lib_weatherfile.cpp).
    const double no_minute = time[4] ? 0.0 : 1800.0;  // [s]
    if (!time[4]) {
        table.notes.push_back("no column Minute: rows are those of the middle of their hour");
    }
    std::vector<PsmUsed> used;
    std::size_t widest = 0;
    for (const PsmColumn& column : psm_columns) {
        for (const char* name : column.name) {
            const auto at = place_of_name(names, name);
            if (!at) continue;
            used.push_back({*at, column.quantity, header.unit(column, name)});
            widest = std::max(widest, *at);
            break;
        }
    }
    for (const auto& at : time) widest = std::max(widest, at.value_or(0));
    std::vector<LocalRow> rows;
    std::vector<std::vector<std::string>> cells;
    for (std::size_t i = psm_header_lines; i < lines.line.size(); ++i) {
        if (lines.line[i].find_first_not_of(" ,\t") == std::string_view::npos) continue;
        const std::string where = lines.where(i);
        std::vector<std::string> row = csv_cells(lines.line[i]);
        if (row.size() <= widest) {
            throw InputError(
                where, fmt::format("found {} cells, expected at least {}", row.size(), widest + 1));
        }
        std::array<int, 5> at{};
        for (std::size_t k = 0; k < time.size(); ++k) {
            if (!time[k]) continue;
            at[k] = int(
                std::lround(number_in(row[*time[k]], fmt::format("{}:{}", where, *time[k] + 1))));
        }
        rows.push_back({at[0], at[1], at[2], 3600.0 * at[3] + 60.0 * at[4] + no_minute, where});
        cells.push_back(std::move(row));
    }
    if (rows.empty()) throw InputError(file.string(), "has no weather, only a header");
    add_local_rows(rows, header.number("time zone"), asked, table, [&](std::size_t i) {
        for (const PsmUsed& one : used) {
            const std::string where = fmt::format("{}:{}", rows[i].where, one.column + 1);
            const std::string& cell = cells[i][one.column];
            const double value = cell.empty() ? not_measured : number_in(cell, where);
            put(table, one.quantity,
                value <= psm_missing ? not_measured : one.unit.factor * value + one.unit.offset,
                where);
        }
    });
    for (const std::string& name : names) {
        const bool is_time = std::find(psm_times.begin(), psm_times.end(), name) != psm_times.end();
        const bool is_used = std::any_of(used.begin(), used.end(), [&](const PsmUsed& one) {
            return names[one.column] == name;
        });
        if (!is_time && !is_used && !name.empty()) table.unused.push_back(name);
    }
    return table;
}

}  // namespace diurna
