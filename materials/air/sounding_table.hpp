#pragma once

#include <filesystem>

#include "materials/base/csv.hpp"

namespace diurna {

/// The table of a radiosonde's levels, whatever its format (materials/air/radiosonde.hpp), with the
/// names that plain CSV has for its columns; rows stand as in the file.
///
/// - CSV of ours: as it is
/// - the University of Wyoming's CSV (pressure_hPa, geopotential height_m, temperature_C, dew point
///   temperature_C, ...)
/// - its text list (columns PRES HGHT TEMP DWPT ... of seven characters below two lines of dashes),
///   bare or in the page it came in; one sounding to a file
///
/// Of the university's formats, levels without height or temperature (those below the ground) and
/// levels less than 5 m or 0.05 hPa above the one before are left out.
CsvTable read_sounding_table(const std::filesystem::path& file);

/// Whether a text has the list's line of columns.
bool is_sounding_list(const std::string& text);

}  // namespace diurna
