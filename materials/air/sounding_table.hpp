#pragma once

#include <filesystem>
#include <string>

#include "materials/air/sounding_rows.hpp"

namespace diurna {

/// The table of a radiosonde's levels, whatever its format (materials/air/radiosonde.hpp), with the
/// names that plain CSV has for its columns; rows stand as in the file.
///
/// - CSV of ours: as it is
/// - the University of Wyoming's CSV (pressure_hPa, geopotential height_m, temperature_C, dew point
///   temperature_C, ...)
/// - its text list (columns PRES HGHT TEMP DWPT ... of seven characters below two lines of dashes),
///   bare or in the page it came in; one sounding to a file
/// - the Integrated Global Radiosonde Archive, version 2 (materials/air/igra.hpp)
///
/// Of the university's formats, levels without height, pressure or temperature (those below the
/// ground) and levels less than 5 m or 0.05 hPa from the one before are skipped. Levels out of
/// order stay, for sounding_levels.hpp to leave out and to note.
///
/// time  of the sounding, where the file is the archive's: "2018-07-15T00"; "": it holds one
SoundingTable read_sounding_table(const std::filesystem::path& file, const std::string& time = "");

/// Whether a text has the list's line of columns.
bool is_sounding_list(const std::string& text);

}  // namespace diurna
