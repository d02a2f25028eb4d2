#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "materials/air/sounding_rows.hpp"

namespace diurna {

/// Whether a text has the format of the Integrated Global Radiosonde Archive, version 2: its first
/// line begins "#USM00072327 2018 07 15 00 2318  151 ...".
bool is_igra(std::string_view text);

/// The nominal times of the file's soundings, "2018-07-15T00", in the file's order.
std::vector<std::string> igra_times(std::string_view text);

/// A sounding of the archive as a table (NOAA NCEI, igra2-data-format.txt): pressures of Pa,
/// geopotential heights of m, temperatures and dew point depressions of 0.1 K, relative humidity of
/// 0.1 %, −9999 missing, −8888 removed as wrong.
///
/// Most levels have a height only at standard pressures: heights between are hydrostatic from the
/// nearest level below that has one, fitted to the next above. Levels without pressure or
/// temperature (wind only) are skipped.
///
/// time     of the sounding, "2018-07-15T00"; "": the file holds a single sounding
/// returns  columns pressure_hPa, height_m, temperature_C, dew_point_C (empty: missing), with notes
///
/// Throws InputError for several soundings without `time`, for a time that no sounding has, and for
/// a sounding without a height.
SoundingTable read_igra(const std::filesystem::path& file, std::string_view text,
                        const std::string& time = "");

}  // namespace diurna
