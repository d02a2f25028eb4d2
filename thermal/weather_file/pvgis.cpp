#include "thermal/weather_file/pvgis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/text_lines.hpp"

namespace diurna {

namespace {

struct PvgisColumn {
    const char* name;
    Quantity quantity;
    double factor = 1.0, offset = 0.0;
};
constexpr std::array<PvgisColumn, 10> pvgis_columns{{
    {"T2m", Quantity::air_temperature, 1.0, zero_celsius},
    {"RH", Quantity::relative_humidity, 0.01},
    {"G(h)", Quantity::shortwave_down},
    {"Gb(n)", Quantity::direct_normal},
    {"Gd(h)", Quantity::diffuse},
    {"IR(h)", Quantity::longwave_down},
    {"WS10m", Quantity::wind_speed},
    {"SP", Quantity::pressure},
    {"G(i)", Quantity::shortwave_down},  // of a series in the horizontal
    {"Gd(i)", Quantity::diffuse},
}};
/// What no weather is made of: the sun's height, power of a PV system, the wind's direction, a flag
/// of reconstructed values.
constexpr std::array pvgis_beside{"H_sun", "P", "WD10m", "Int", "Gb(i)", "Gr(i)"};
constexpr std::size_t most_header_lines = 40;

/// The number of a line "Elevation (m): 250.0"; `otherwise` where no line begins so.
double header_number(const TextLines& lines, std::string_view name, double otherwise) {
    for (std::size_t i = 0; i < std::min(lines.line.size(), most_header_lines); ++i) {
        if (!lines.line[i].starts_with(name)) continue;
        const std::size_t colon = lines.line[i].find(':');
        if (colon == std::string_view::npos) continue;
        const auto words = words_of(lines.line[i].substr(colon + 1));
        return number_in(words.empty() ? "" : words.front(), lines.where(i));
    }
    return otherwise;
}

/// The cells of a PVGIS file by its line of columns.
struct PvgisCells {
    std::vector<std::string> names;
    std::vector<LocalRow> rows;
    std::vector<std::vector<std::string>> cells;

    bool has(const char* name) const {
        return std::find(names.begin(), names.end(), name) != names.end();
    }
    /// NaN of an empty cell; the column must be there.
    double number(std::size_t row, const char* name) const {
        const auto column =
            std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
        const std::string& cell = cells[row][column];
        return cell.empty() ? not_measured : number_in(cell, where(row, column));
    }
    std::string where(std::size_t row, std::size_t column) const {
        return fmt::format("{}:{}", rows[row].where, column + 1);
    }
};

/// The line of the head that begins with a name; none: the number of lines.
std::size_t header_line_of(const TextLines& lines, std::string_view name) {
    const std::size_t count = std::min(lines.line.size(), most_header_lines);
    for (std::size_t i = 0; i < count; ++i) {
        if (lines.line[i].starts_with(name)) return i;
    }
    return lines.line.size();
}

/// Throws InputError unless the irradiance of a series is of the horizontal plane: its slope is 0,
/// or, where the file names none, no light is reflected onto it from the ground.
void check_horizontal(const TextLines& lines, const PvgisCells& series) {
    constexpr double level = 0.5;  // [deg]
    constexpr const char* remedy =
        "download the series with slope 0, or a typical year (TMY), which has horizontal and beam "
        "irradiance";
    const std::size_t at = header_line_of(lines, "Slope");
    if (at < lines.line.size()) {
        const std::size_t colon = lines.line[at].find(':');
        const auto words =
            words_of(lines.line[at].substr(colon == std::string_view::npos ? 0 : colon + 1));
        double slope = 0.0;
        if (!words.empty() && parse_number(std::string(words.front()), slope) &&
            std::abs(slope) < level) {
            return;
        }
        throw InputError(lines.where(at),
                         fmt::format("found '{}', expected 'Slope: 0 deg.': this series is for an "
                                     "inclined or moving plane",
                                     lines.line[at].substr(0, 60)),
                         remedy);
    }
    bool reflected = !series.has("Gr(i)");
    for (std::size_t row = 0; row < series.rows.size() && !reflected; ++row) {
        reflected = series.number(row, "Gr(i)") > 0.0;
    }
    if (!reflected) return;
    throw InputError(
        lines.path.string(),
        "no line 'Slope: 0 deg.' in its header: the plane of its irradiance is unknown", remedy);
}

}  // namespace

bool is_pvgis(std::string_view text) { return text.starts_with("Latitude (decimal degrees)"); }

WeatherTable read_pvgis(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    std::size_t head = 0;
    while (head < lines.line.size() && !lines.line[head].starts_with("time")) ++head;
    if (head == lines.line.size()) {
        throw InputError(file.string(),
                         "a PVGIS file without its line of columns, which begins with time(UTC)");
    }
    WeatherTable table{.file = file, .format = "PVGIS"};
    table.stamps = Stamp::instant;
    table.states_at_stamp = true;
    table.place = {header_number(lines, "Latitude", not_measured),
                   header_number(lines, "Longitude", not_measured),
                   header_number(lines, "Elevation", not_measured)};
    const double offset_h = header_number(lines, "Irradiance Time Offset", 0.0);
    check_within(file.string() + ": irradiance time offset [h]", offset_h, -24.0, 24.0);
    table.light_offset = 3600.0 * offset_h;
    PvgisCells file_cells;
    std::vector<std::string>& names = file_cells.names;
    for (std::string& name : names = csv_cells(lines.line[head])) {
        name = name.substr(0, name.find_last_not_of(" \t\r") + 1);
    }
    std::vector<LocalRow>& rows = file_cells.rows;
    std::vector<std::vector<std::string>>& cells = file_cells.cells;
    for (std::size_t i = head + 1; i < lines.line.size(); ++i) {
        std::vector<std::string> row = csv_cells(lines.line[i]);
        if (row.size() != names.size()) break;  // the legend below
        LocalRow one{.where = lines.where(i)};
        int hour = 0, minute = 0, taken = 0;
        if (std::sscanf(row[0].c_str(), "%4d%2d%2d:%2d%2d%n", &one.year, &one.month, &one.day,
                        &hour, &minute, &taken) != 5 ||
            taken != int(row[0].size())) {
            throw InputError(one.where, fmt::format("found '{}', expected a time such as "
                                                    "20180708:0500",
                                                    row[0].substr(0, 40)));
        }
        one.seconds = 3600.0 * hour + 60.0 * minute;
        rows.push_back(one);
        cells.push_back(std::move(row));
    }
    if (rows.empty()) throw InputError(file.string(), "has no weather, only a header");
    const bool series = file_cells.has("G(i)") || file_cells.has("Gb(i)");
    const bool in_parts =
        !file_cells.has("G(i)") && file_cells.has("Gb(i)") && file_cells.has("Gd(i)");
    if (series) check_horizontal(lines, file_cells);
    add_local_rows(rows, 0.0, asked, table, [&](std::size_t i) {
        for (const PvgisColumn& c : pvgis_columns) {
            if (!file_cells.has(c.name)) continue;
            put(table, c.quantity, c.factor * file_cells.number(i, c.name) + c.offset,
                rows[i].where);
        }
        if (!in_parts) return;
        const double reflected = file_cells.has("Gr(i)") ? file_cells.number(i, "Gr(i)") : 0.0;
        put(table, Quantity::shortwave_down,
            file_cells.number(i, "Gb(i)") + file_cells.number(i, "Gd(i)") + reflected,
            rows[i].where);
    });
    for (std::size_t k = 1; k < names.size(); ++k) {
        const bool beside =
            std::find(pvgis_beside.begin(), pvgis_beside.end(), names[k]) != pvgis_beside.end();
        const bool used = std::any_of(pvgis_columns.begin(), pvgis_columns.end(),
                                      [&](const PvgisColumn& c) { return names[k] == c.name; });
        if (!used && !beside) table.unused.push_back(names[k]);
    }
    if (series) {
        table.notes.push_back(
            "PVGIS hourly series: irradiance on the horizontal plane at the rows' times");
    }
    if (offset_h != 0.0) {
        table.notes.push_back(fmt::format(
            "sunlight is that of the instants {:.0f} min {} the rows' times, as the file states",
            std::abs(60.0 * offset_h), offset_h < 0.0 ? "before" : "after"));
    }
    return table;
}

}  // namespace diurna
