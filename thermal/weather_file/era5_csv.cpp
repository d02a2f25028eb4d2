#include "thermal/weather_file/era5_csv.hpp"

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/stamps.hpp"

namespace diurna {

WeatherTable read_era5_csv(const std::filesystem::path& file) {
    const CsvTable csv = read_csv(file);
    if (csv.rows.empty()) throw InputError(file.string(), "holds no weather, only a header");
    WeatherTable table{.file = file, .format = "ERA5 CSV"};
    const std::size_t time = csv.column("valid_time");
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        const std::string where = csv.where(row, time);
        add_row(table, stamp_in(csv.rows[row][time], 0.0, where), where);
    }
    Era5Values values;
    for (const std::string& name : era5_names()) {
        if (!csv.has(name)) continue;
        const std::size_t column = csv.column(name);
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            values[name].push_back(csv.rows[row][column].empty() ? not_measured
                                                                 : csv.number(row, column));
        }
    }
    put_era5(values, table);
    if (csv.has("latitude") && csv.has("longitude")) {
        const std::size_t north = csv.column("latitude"), east = csv.column("longitude");
        table.place = {csv.number(0, north), csv.number(0, east), not_measured};
        for (std::size_t row = 1; row < csv.rows.size(); ++row) {
            if (csv.rows[row][north] == csv.rows[0][north] &&
                csv.rows[row][east] == csv.rows[0][east]) {
                continue;
            }
            throw InputError(csv.where(row, north), "another place than the row before",
                             "extract one point");
        }
    }
    return table;
}

}  // namespace diurna
