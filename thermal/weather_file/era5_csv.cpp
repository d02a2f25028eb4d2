#include "thermal/weather_file/era5_csv.hpp"

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/stamps.hpp"

namespace diurna {

namespace {

Era5Series csv_series_of(const CsvTable& csv) {
    if (csv.rows.empty()) throw InputError(csv.path.string(), "has no weather, only a header");
    Era5Series series{.file = csv.path, .format = "ERA5 CSV"};
    const std::size_t time = csv.column("valid_time");
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        const std::string where = csv.where(row, time);
        add_stamp(series, stamp_in(csv.rows[row][time], 0.0, where), where);
    }
    for (const std::string& name : era5_names()) {
        if (!csv.has(name)) continue;
        const std::size_t column = csv.column(name);
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            series.values[name].push_back(csv.rows[row][column].empty() ? not_measured
                                                                        : csv.number(row, column));
        }
    }
    for (const std::string& name : csv.header) {
        if (!is_era5_name(name) && name != "valid_time") series.unused.push_back(name);
    }
    if (csv.has("latitude") && csv.has("longitude")) {
        const std::size_t north = csv.column("latitude"), east = csv.column("longitude");
        series.place = {csv.number(0, north), csv.number(0, east), not_measured};
        for (std::size_t row = 1; row < csv.rows.size(); ++row) {
            if (csv.rows[row][north] == csv.rows[0][north] &&
                csv.rows[row][east] == csv.rows[0][east]) {
                continue;
            }
            throw InputError(csv.where(row, north), "has another place than the previous row",
                             "extract a single point");
        }
    }
    return series;
}

}  // namespace

Era5Series read_era5_csv(const std::filesystem::path& file) {
    return csv_series_of(read_csv(file));
}

Era5Series era5_csv_series(const std::filesystem::path& file, std::string_view text) {
    return csv_series_of(csv_table(file, text));
}

}  // namespace diurna
