#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "thermal/weather_file/quantity.hpp"

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

/// Lines of [weather.columns]: "Temp (°C)" = "air_temperature degC".
std::vector<std::string> as_declarations(const std::vector<RecognisedColumn>& columns);

}  // namespace diurna
