#pragma once

#include <filesystem>
#include <string>

#include "materials/air/sounding_rows.hpp"

namespace diurna {

/// The table of a radiosonde's levels in any of the formats (materials/air/radiosonde.hpp), with
/// the column names of the plain CSV; rows in the file's order.
///
/// - plain CSV: unchanged
/// - the University of Wyoming's CSV (pressure_hPa, geopotential height_m, temperature_C, dew point
///   temperature_C, ...)
/// - its text list (columns PRES HGHT TEMP DWPT ... of seven characters below two lines of dashes),
///   as text or within its web page; one sounding per file
/// - the Integrated Global Radiosonde Archive, version 2 (materials/air/igra.hpp)
///
/// In the university's formats, levels without height, pressure or temperature (those below the
/// ground) and levels less than 5 m or 0.05 hPa from the previous one are skipped. Levels out of
/// order are not skipped here: sounding_levels.hpp removes and notes them.
///
/// time  of the sounding in a file of the archive: "2018-07-15T00"; "": a single sounding
SoundingTable read_sounding_table(const std::filesystem::path& file, const std::string& time = "");

/// Whether a text has the list's line of columns.
bool is_sounding_list(const std::string& text);

}  // namespace diurna
