#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/products/export/inspect.hpp"
#include "thermal/weather_file/foreign_columns.hpp"
#include "thermal/weather_file/read_weather.hpp"
#include "thermal/weather_file/unused_columns.hpp"

namespace diurna {

Found inspect_weather(const std::filesystem::path& file) {
    const std::vector<RecognisedColumn> recognised = recognised_columns_of(file);
    WeatherOptions options;
    options.columns = declared_columns(recognised);
    WeatherTable table = read_weather_table(file, options);
    warn_of_unused_columns(table);
    const double step = usual_interval(table.stamp);
    Found found{.kind = "weather"};
    found.fact = {{"format", {table.format}},
                  {"rows", {static_cast<long long>(table.stamp.size())}},
                  {"first", {format_instant(table.stamp.front())}},
                  {"last", {format_instant(table.stamp.back())}},
                  {"usual_step_s", {step}}};
    if (table.place) {
        found.fact.push_back({"station_latitude_deg", {table.place->latitude_deg}});
        found.fact.push_back({"station_longitude_deg", {table.place->longitude_deg}});
        found.fact.push_back({"station_height_m", {table.place->height}});
    }
    FoundTable columns{"columns", {"column", "rows", "missing", "least", "most", "mean"}, {}};
    for (std::size_t q = 0; q < quantity_count; ++q) {
        const std::vector<double>& values = table.value[q];
        if (values.empty()) continue;
        double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0.0;
        long long known = 0;
        for (const double v : values) {
            if (!std::isfinite(v)) continue;
            least = std::min(least, v);
            most = std::max(most, v);
            sum += v;
            ++known;
        }
        columns.row.push_back({facts(quantity_at(q)).column, known,
                               static_cast<long long>(values.size()) - known, least, most,
                               sum / static_cast<double>(known)});
    }
    FoundTable gaps{"gaps", {"from", "to", "seconds"}, {}};
    for (std::size_t i = 1; i < table.stamp.size(); ++i) {
        const double apart = seconds_between(table.stamp[i - 1], table.stamp[i]);
        if (apart <= 1.5 * step) continue;
        gaps.row.push_back(
            {format_instant(table.stamp[i - 1]), format_instant(table.stamp[i]), apart});
    }
    if (!recognised.empty()) {
        found.fact.push_back({"read_as", {}});
        for (const std::string& line : as_declarations(recognised)) {
            found.fact.back().value.emplace_back(line);
        }
    }
    found.fact.push_back({"gaps_in_time", {static_cast<long long>(gaps.row.size())}});
    found.table.push_back(std::move(columns));
    if (!gaps.row.empty()) found.table.push_back(std::move(gaps));
    if (!table.warnings.empty()) {
        found.fact.push_back({"warnings", {}});
        for (const Mistake& one : table.warnings) found.fact.back().value.emplace_back(one.line());
    }
    if (!table.notes.empty()) {
        found.fact.push_back({"notes", {table.notes.begin(), table.notes.end()}});
    }
    found.next = fmt::format("diurna new FOLDER --dem DEM --weather {}", file.string());
    return found;
}

}  // namespace diurna
