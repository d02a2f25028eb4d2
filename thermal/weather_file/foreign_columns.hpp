#pragma once

#include <filesystem>
#include <vector>

#include "thermal/weather_file/own_csv.hpp"
#include "thermal/weather_file/recognised_columns.hpp"

namespace diurna {

/// Declarations of a weather file in CSV whose own column names are not the program's, if time and
/// air temperature are recognised with offset and unit; else none.
std::vector<RecognisedColumn> recognised_columns_of(const std::filesystem::path& file);

/// For WeatherOptions::columns; those that are not whole are skipped.
std::vector<DeclaredColumn> declared_columns(const std::vector<RecognisedColumn>& columns);

}  // namespace diurna
