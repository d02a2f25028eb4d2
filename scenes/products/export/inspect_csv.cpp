#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/read_brdf.hpp"
#include "scenes/products/export/inspect.hpp"
#include "thermal/weather_file/foreign_columns.hpp"
#include "thermal/weather_file/quantity.hpp"

namespace diurna {

namespace {

bool has_all(const CsvTable& table, std::initializer_list<const char*> names) {
    return std::all_of(names.begin(), names.end(),
                       [&](const char* name) { return table.has(name); });
}

bool has_any(const CsvTable& table, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return table.has(name); });
}

/// What the header says that a table is, and where a scene names it.
struct TableKind {
    const char* kind;
    const char* next;
};

const TableKind* kind_of_header(const CsvTable& table) {
    static constexpr TableKind brdf{"reflectance by angles",
                                    "use it as file of a material's finish of kind measured"},
        refraction{"refractive index", "use it as file of a material's finish"},
        response{"spectrum", "use it as response in [[bands]] of a scene"},
        spectrum{"spectrum", "use it as spectrum of a material of a scene"},
        way{"trajectory", "use it as file of a [[trajectory]] of a scene"},
        places{"places", "use it as copies_file of an [[object]] of a scene"};
    if (has_all(table, {"light_deg", "eye_deg", "brdf_sr"})) return &brdf;
    if (has_all(table, {"wavelength_um", "n", "k"})) return &refraction;
    if (has_any(table, {"wavelength_um", "wavelength_nm"})) {
        return table.has("response") ? &response : &spectrum;
    }
    const bool placed =
        has_all(table, {"east_m", "north_m"}) || has_all(table, {"latitude_deg", "longitude_deg"});
    if (placed) return has_any(table, {"time", "time_s"}) ? &way : &places;
    return nullptr;
}

bool is_sounding(const CsvTable& table) {
    return table.has("pressure_hPa") &&
           has_any(table, {"height_m", "height_km", "geopotential height_m"});
}

/// Least, most and mean of each column of numbers.
FoundTable facts_of_columns(const CsvTable& table) {
    FoundTable columns{"columns", {"column", "rows", "least", "most", "mean"}, {}};
    for (std::size_t c = 0; c < table.header.size(); ++c) {
        double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0.0;
        long long known = 0;
        for (const auto& row : table.rows) {
            double value = 0.0;
            if (!parse_number(row[c], value)) continue;
            least = std::min(least, value);
            most = std::max(most, value);
            sum += value;
            ++known;
        }
        if (known == 0) least = most = std::nan("");
        columns.row.push_back(
            {table.header[c], known, least, most, sum / static_cast<double>(known)});
    }
    return columns;
}

}  // namespace

Found inspect_brdf(const std::filesystem::path& file) {
    const MeasuredBrdf brdf = read_brdf(file);
    Found found{.kind = "reflectance by angles"};
    found.fact = {{"values", {static_cast<long long>(brdf.value.size())}},
                  {"least_per_sr", {*std::min_element(brdf.value.begin(), brdf.value.end())}},
                  {"most_per_sr", {*std::max_element(brdf.value.begin(), brdf.value.end())}}};
    found.next = "use it as file of a material's finish of kind measured";
    return found;
}

Found inspect_csv(const std::filesystem::path& file) {
    if (!recognised_columns_of(file).empty()) return inspect_weather(file);
    std::string separator;
    const CsvTable table = weather_cells(file, 0, separator);
    if (is_sounding(table)) return inspect_sounding(file);
    const bool weather = std::any_of(
        table.header.begin(), table.header.end(),
        [](const std::string& column) { return quantity_of_column(column).has_value(); });
    if (weather) return inspect_weather(file);
    if (const TableKind* kind = kind_of_header(table)) {
        Found found{.kind = kind->kind};
        found.fact = {{"rows", {static_cast<long long>(table.rows.size())}}};
        found.table.push_back(facts_of_columns(table));
        found.next = kind->next;
        return found;
    }
    if (table.has("time")) {
        Found found{.kind = "curves"};
        found.fact = {{"rows", {static_cast<long long>(table.rows.size())}}};
        found.table.push_back(facts_of_columns(table));
        found.next = "use it as measured in [calibrate] of a column file, with column and unit";
        return found;
    }
    const std::vector<std::string> recognised = as_declarations(recognised_columns(table));
    throw InputError(
        file.string(),
        fmt::format("is a table of the columns '{}'; expected those of weather (time, "
                    "air_temperature_K, ...), a sounding, a spectrum, a trajectory or places",
                    fmt::join(table.header, "', '")),
        fmt::format("weather of other names is declared in [weather.columns] of a scene{}{}",
                    recognised.empty() ? "" : "; recognised: ", fmt::join(recognised, ", ")));
}

}  // namespace diurna
