#include "thermal/weather_file/foreign_columns.hpp"

#include <algorithm>
#include <string>

#include "materials/base/error.hpp"
#include "thermal/weather_file/weather_format.hpp"

namespace diurna {

std::vector<RecognisedColumn> recognised_columns_of(const std::filesystem::path& file) {
    if (weather_format(file) != WeatherFormat::csv) return {};
    std::string separator;
    const CsvTable table = weather_cells(file, 0, separator);
    if (table.has("time") && table.has("air_temperature_K")) return {};
    std::vector<RecognisedColumn> found = recognised_columns(table);
    const auto has = [&](std::optional<Quantity> quantity) {
        return std::any_of(found.begin(), found.end(), [&](const RecognisedColumn& one) {
            return one.quantity == quantity && one.whole;
        });
    };
    if (!has(std::nullopt) || !has(Quantity::air_temperature)) return {};
    std::erase_if(found, [](const RecognisedColumn& one) { return !one.whole; });
    return found;
}

std::vector<DeclaredColumn> declared_columns(const std::vector<RecognisedColumn>& columns) {
    std::vector<DeclaredColumn> declared;
    for (const RecognisedColumn& one : columns) {
        if (one.whole) declared.push_back(declared_column(one.name, one.says, one.name));
    }
    return declared;
}

}  // namespace diurna
