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
constexpr std::array<PvgisColumn, 8> pvgis_columns{{
    {"T2m", Quantity::air_temperature, 1.0, zero_celsius},
    {"RH", Quantity::relative_humidity, 0.01},
    {"G(h)", Quantity::shortwave_down},
    {"Gb(n)", Quantity::direct_normal},
    {"Gd(h)", Quantity::diffuse},
    {"IR(h)", Quantity::longwave_down},
    {"WS10m", Quantity::wind_speed},
    {"SP", Quantity::pressure},
}};
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

}  // namespace

bool is_pvgis(std::string_view text) { return text.starts_with("Latitude (decimal degrees)"); }

WeatherTable read_pvgis(const std::filesystem::path& file, const AskedSpan& asked) {
    const TextLines lines(file);
    std::size_t head = 0;
    while (head < lines.line.size() && !lines.line[head].starts_with("time")) ++head;
    if (head == lines.line.size()) {
        throw InputError(file.string(),
                         "a file of PVGIS without its line of columns, which "
                         "begins with time(UTC)");
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
    const std::vector<std::string> names = csv_cells(lines.line[head]);
    std::vector<LocalRow> rows;
    std::vector<std::vector<std::string>> cells;
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
    if (rows.empty()) throw InputError(file.string(), "holds no weather, only a header");
    add_local_rows(rows, 0.0, asked, table, [&](std::size_t i) {
        for (const PvgisColumn& c : pvgis_columns) {
            const auto at = std::find(names.begin(), names.end(), c.name);
            if (at == names.end()) continue;
            const auto column = std::size_t(at - names.begin());
            const std::string where = fmt::format("{}:{}", rows[i].where, column + 1);
            const double value =
                cells[i][column].empty() ? not_measured : number_in(cells[i][column], where);
            put(table, c.quantity, c.factor * value + c.offset, where);
        }
    });
    if (offset_h != 0.0) {
        table.notes.push_back(
            fmt::format("sunlight is of the instants {:.0f} min {} the rows' "
                        "times, as the file says",
                        std::abs(60.0 * offset_h), offset_h < 0.0 ? "before" : "after"));
    }
    return table;
}

}  // namespace diurna
