#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "thermal/weather_file/own_csv.hpp"

namespace diurna {

/// What the name of a column in a third-party table says: "Temp (°C)" is "air_temperature degC",
/// "Wind_m_s" is "wind_speed m/s", "time_utc" is "time UTC".
struct RecognisedColumn {
    std::string name;                    // in the header
    std::optional<Quantity> quantity{};  // none: the time
    std::string says;    // for [weather.columns]; with "UNIT" or "UTC-OFFSET" where that is unknown
    bool whole = false;  // nothing is unknown
};

/// The columns of a table that are recognised, each quantity once.
///
/// A unit is what stands in brackets or after the last '_', ' ' or ','; a time has its offset in
/// its name (UTC, GMT) or in its cells.
std::vector<RecognisedColumn> recognised_columns(const CsvTable& table);

/// Declarations of a weather file in CSV whose own column names are not the program's, if time and
/// air temperature are recognised with offset and unit; else none.
std::vector<RecognisedColumn> recognised_columns_of(const std::filesystem::path& file);

/// For WeatherOptions::columns; those that are not whole are skipped.
std::vector<DeclaredColumn> declared_columns(const std::vector<RecognisedColumn>& columns);

/// Lines of [weather.columns]: "Temp (°C)" = "air_temperature degC".
std::vector<std::string> as_declarations(const std::vector<RecognisedColumn>& columns);

}  // namespace diurna
