#include "thermal/weather_file/own_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "thermal/weather_file/recognised_columns.hpp"
#include "thermal/weather_file/separators.hpp"
#include "thermal/weather_file/stamps.hpp"
#include "thermal/weather_file/weather_text.hpp"

namespace diurna {

namespace {

/// Where in the file a column is, and what it holds.
struct UsedColumn {
    std::size_t column;
    Quantity quantity;
    Unit unit;
};

struct Layout {
    std::size_t time = 0;
    std::vector<std::size_t> part_column;  // of a time in several columns; else empty
    std::vector<TimePart> part;
    double offset_h = not_measured;
    std::vector<UsedColumn> used;
    std::vector<std::string> unused;
};

std::vector<std::string> own_columns() {
    std::vector<std::string> known{"time"};
    for (std::size_t i = 0; i < quantity_count; ++i) {
        known.emplace_back(facts(quantity_at(i)).column);
    }
    return known;
}

/// Mistakes of columns that no weather file has: each by itself, or many in one line.
void add_unknown(const CsvTable& csv, const std::vector<std::size_t>& unknown,
                 std::vector<Mistake>& mistakes) {
    constexpr std::size_t most_by_themselves = 4;
    const auto where = [&](std::size_t c) {
        return fmt::format("{}:{}:{}: {}", csv.path.string(), csv.header_line, c + 1,
                           csv.header[c]);
    };
    if (unknown.size() > most_by_themselves) {
        mistakes.push_back(
            {where(unknown.front()),
             fmt::format("this and {} more columns have no known name", unknown.size() - 1),
             "describe the columns to be used in [weather.columns]; others are ignored"});
        return;
    }
    for (const std::size_t c : unknown) {
        const std::string near = did_you_mean(csv.header[c], own_columns());
        mistakes.push_back({where(c), "is not a known column name",
                            near.empty()
                                ? fmt::format("describe it in [weather.columns]: {} = "
                                              "\"air_temperature degC\", \"wind_speed kn\" ...",
                                              csv.header[c])
                                : near});
    }
}

/// What a table has whose columns are mostly not the program's, and how to declare them.
Mistake foreign_table(const CsvTable& csv) {
    constexpr std::size_t most = 12;
    const std::size_t shown = std::min(most, csv.header.size());
    const std::vector<std::string> names(csv.header.begin(),
                                         csv.header.begin() + std::ptrdiff_t(shown));
    const std::vector<std::string> known = as_declarations(recognised_columns(csv));
    return {fmt::format("{}:{}", csv.path.string(), csv.header_line),
            fmt::format("found the columns '{}'{}, expected time, air_temperature_K and, if "
                        "measured, relative_humidity, wind_speed_m_s, pressure_Pa, "
                        "shortwave_down_W_m2, longwave_down_W_m2 ...",
                        fmt::join(names, "', '"),
                        csv.header.size() > shown
                            ? fmt::format(" and {} more", csv.header.size() - shown)
                            : ""),
            known.empty() ? "declare them in [weather.columns]: NAME = \"time UTC\", NAME = "
                            "\"air_temperature degC\", NAME = \"wind_speed m/s\" ..."
                          : fmt::format("declare them in [weather.columns]; recognised: {}",
                                        fmt::join(known, ", "))};
}

/// Throws InputError for columns that no weather file has, or that are declared and not there.
Layout layout_of(const CsvTable& csv, const std::vector<DeclaredColumn>& declared) {
    Layout layout;
    std::vector<Mistake> mistakes;
    const std::string file = csv.path.string();
    for (const DeclaredColumn& d : declared) {
        if (csv.has(d.name)) continue;
        mistakes.push_back({file, "no column '" + d.name + "' of [weather.columns] in the header",
                            did_you_mean(d.name, csv.header)});
    }
    bool has_time = false;
    std::vector<std::size_t> unknown;
    std::array<bool, quantity_count> taken{};
    for (std::size_t c = 0; c < csv.header.size(); ++c) {
        const std::string& name = csv.header[c];
        const auto found = std::find_if(declared.begin(), declared.end(),
                                        [&](const DeclaredColumn& d) { return d.name == name; });
        const bool is_declared = found != declared.end();
        const std::optional<Quantity> quantity =
            is_declared ? found->quantity : quantity_of_column(name);
        if (is_declared ? !found->quantity : name == "time") {
            if (has_time && !is_declared) continue;
            if (is_declared && !std::isnan(found->offset_h)) layout.offset_h = found->offset_h;
            has_time = true;
            if (is_declared && found->part != TimePart::whole) {
                if (layout.part.empty()) layout.time = c;
                layout.part_column.push_back(c);
                layout.part.push_back(found->part);
                continue;
            }
            layout.time = c;
        } else if (quantity) {
            if (taken[index(*quantity)]) {
                mistakes.push_back(
                    {file + ": " + name,
                     fmt::format("is the second column for {}", facts(*quantity).name), ""});
            }
            taken[index(*quantity)] = true;
            layout.used.push_back({c, *quantity, is_declared ? found->unit : Unit{}});
        } else if (declared.empty()) {
            unknown.push_back(c);
        } else {
            layout.unused.push_back(name);
        }
    }
    if (!unknown.empty() && !(has_time && taken[index(Quantity::air_temperature)])) {
        throw InputError({foreign_table(csv)});
    }
    add_unknown(csv, unknown, mistakes);
    if (!has_time) mistakes.push_back({file, "no column 'time' in the header", ""});
    if (!taken[index(Quantity::air_temperature)]) {
        mistakes.push_back({file, "no column 'air_temperature_K' in the header",
                            "describe other names or units in [weather.columns]"});
    }
    if (!mistakes.empty()) throw InputError(mistakes);
    if (layout.part.empty()) return layout;
    check_time_parts(layout.part, file);
    if (std::isnan(layout.offset_h)) {
        throw InputError(file, "the times of its columns have no UTC offset",
                         fmt::format("set it once: [weather.columns] {} = \"{} -07:00\"",
                                     csv.header[layout.time],
                                     time_part_names()[std::size_t(layout.part.front())]));
    }
    return layout;
}

/// Marks of what was not measured that no number can be mistaken for.
bool missing(const std::string& cell, bool foreign) {
    static const std::array<std::string_view, 10> marks{"",     "nan",  "na", "n/a", "#n/a",
                                                        "null", "none", "--", "---", "-"};
    const std::string small = small_letters(cell);
    if (std::find(marks.begin(), marks.end(), small) != marks.end()) return true;
    return foreign && (cell == "M" || cell == "*");
}

/// Campbell's TOA5: a line of the station, names, units and kinds of processing, then rows.
bool is_toa5(const std::string& text) {
    return text.starts_with("\"TOA5\"") || text.starts_with("TOA5,");
}

/// Takes the lines of units and processing out of the rows of a TOA5 file.
void drop_toa5_lines(CsvTable& csv) {
    const std::size_t lines = std::min<std::size_t>(2, csv.rows.size());
    csv.rows.erase(csv.rows.begin(), csv.rows.begin() + std::ptrdiff_t(lines));
    csv.line.erase(csv.line.begin(), csv.line.begin() + std::ptrdiff_t(lines));
}

/// Rows from the first instant on, where the file has the newest first.
void turn_newest_first(CsvTable& csv, std::vector<Instant>& stamps, WeatherTable& table) {
    const bool falls = stamps.size() > 1 &&
                       std::adjacent_find(stamps.begin(), stamps.end(), [](Instant a, Instant b) {
                           return a <= b;
                       }) == stamps.end();
    if (!falls) return;
    std::reverse(stamps.begin(), stamps.end());
    std::reverse(csv.rows.begin(), csv.rows.end());
    std::reverse(csv.line.begin(), csv.line.end());
    table.notes.push_back("its rows are read from the last to the first: the newest is first");
}

/// The instant of a row's stamp.
Instant stamp_of(const CsvTable& csv, std::size_t row, const Layout& layout,
                 const std::string& where) {
    if (layout.part.empty()) return stamp_in(csv.rows[row][layout.time], layout.offset_h, where);
    std::vector<TimeCell> cells;
    for (std::size_t k = 0; k < layout.part.size(); ++k) {
        cells.push_back({layout.part[k], csv.rows[row][layout.part_column[k]]});
    }
    return instant_of_parts(cells, layout.offset_h, where);
}

/// What counts as nothing measured.
struct Missing {
    bool foreign;                     // "M" too, and "T" of rain
    const std::vector<double>& code;  // as the file has it
};

/// A cell in SI; NaN where it is missing. A trace of rain ("T") is none.
double value_of(const CsvTable& csv, std::size_t row, const UsedColumn& c, const Missing& none,
                double interval) {
    const std::string& cell = csv.rows[row][c.column];
    if (missing(cell, none.foreign)) return not_measured;
    if (none.foreign && c.quantity == Quantity::rain && cell == "T") return 0.0;
    const double read = csv.number(row, c.column);
    if (std::find(none.code.begin(), none.code.end(), read) != none.code.end()) {
        return not_measured;
    }
    const double value = c.unit.factor * read + c.unit.offset;
    if (!c.unit.per_interval) return value;
    return interval > 0.0 ? value / interval : not_measured;
}

/// Lines that known services put above the header: Open-Meteo's place and its values, NASA POWER's
/// text between -BEGIN HEADER- and -END HEADER-.
int known_lines_above(const std::string& text) {
    const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    const std::string_view all = std::string_view(text).substr(begin);
    if (all.starts_with("latitude,longitude,elevation,utc_offset_seconds")) return 2;
    if (is_toa5(std::string(all.substr(0, 6)))) return 1;
    const std::size_t end = all.find("-END HEADER-");
    if (!all.starts_with("-BEGIN HEADER-") || end == std::string_view::npos) return 0;
    return 1 + int(std::count(all.begin(), all.begin() + std::ptrdiff_t(end), '\n'));
}

}  // namespace

DeclaredColumn declared_column(const std::string& name, const std::string& says,
                               const std::string& where) {
    DeclaredColumn column{.name = name};
    const std::size_t blank = says.find(' ');
    const std::string word = says.substr(0, blank);
    std::string unit = blank == std::string::npos ? "" : says.substr(blank + 1);
    std::erase_if(unit, [](char c) { return c == ' ' || c == '[' || c == ']'; });
    if (const auto part = time_part_named(word)) {
        column.part = *part;
        if (!unit.empty() && !offset_in(unit, column.offset_h)) {
            throw InputError(
                where,
                fmt::format("found offset '{}', expected UTC or an offset such as -05:00", unit));
        }
        return column;
    }
    column.quantity = quantity_named(word);
    if (!column.quantity) {
        std::vector<std::string> known = quantity_names();
        const std::vector<std::string> times = time_part_names();
        known.insert(known.begin(), times.begin(), times.end());
        refuse_word(where, word, known);
    }
    const std::optional<Unit> found = unit_named(*column.quantity, unit);
    if (!found) refuse_word(where, unit, unit_names(*column.quantity));
    column.unit = *found;
    return column;
}

CsvTable weather_cells(const std::filesystem::path& file, int skip_lines, std::string& separator) {
    const std::string text = weather_text(file);
    const int skip = skip_lines > 0 ? skip_lines : known_lines_above(text);
    CsvTable csv = csv_table(file, with_commas(text, skip, separator), skip);
    if (skip_lines == 0 && is_toa5(text)) drop_toa5_lines(csv);
    return csv;
}

WeatherTable read_own_csv(const std::filesystem::path& file,
                          const std::vector<DeclaredColumn>& declared,
                          const std::vector<double>& missing_codes, int skip_lines) {
    std::string separator;
    CsvTable csv = weather_cells(file, skip_lines, separator);
    const bool foreign = !declared.empty();
    const Layout layout = layout_of(csv, declared);
    if (csv.rows.empty()) throw InputError(file.string(), "has no weather, only a header");
    WeatherTable table{.file = file, .format = "CSV"};
    table.declarable = true;
    if (!separator.empty()) {
        table.notes.push_back(fmt::format("read with {} between cells", separator));
    }
    std::vector<Instant> stamps;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        stamps.push_back(stamp_of(csv, row, layout, csv.where(row, layout.time)));
    }
    turn_newest_first(csv, stamps, table);
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        add_row(table, stamps[row], csv.where(row, layout.time));
    }
    const double interval = usual_interval(table.stamp);
    const Missing none{foreign, missing_codes};
    for (const UsedColumn& c : layout.used) {
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            const double value = value_of(csv, row, c, none, interval);
            double read = value;
            if (!std::isnan(value) && !parse_number(csv.rows[row][c.column], read)) read = value;
            check_range(c.quantity, value, csv.where(row, c.column), true, read);
            table.of(c.quantity).push_back(value);
        }
    }
    if (!layout.unused.empty()) {
        table.notes.push_back(fmt::format("columns not used: {}", fmt::join(layout.unused, ", ")));
    }
    table.unused = layout.unused;
    return table;
}

}  // namespace diurna
