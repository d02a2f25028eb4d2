#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "materials/air/sounding_rows.hpp"

namespace diurna {

/// Whether a text is of the Integrated Global Radiosonde Archive, version 2: its first line is
/// "#USM00072327 2018 07 15 00 2318  151 ...".
bool is_igra(std::string_view text);

/// The nominal times of its soundings, "2018-07-15T00", in its order.
std::vector<std::string> igra_times(std::string_view text);

/// A sounding of the archive as a table (NOAA NCEI, igra2-data-format.txt): pressures of Pa,
/// geopotential heights of m, temperatures and dew point depressions of 0.1 K, relative humidity of
/// 0.1 %, −9999 missing, −8888 removed as wrong.
///
/// Most levels have a height of standard pressures only: those between are hydrostatic from the
/// nearest below that has one, fitted to the next above. Levels without pressure or temperature
/// (of wind alone) are passed over.
///
/// time     of the sounding, "2018-07-15T00"; "": the file holds one
/// returns  columns pressure_hPa, height_m, temperature_C, dew_point_C (empty: missing), with notes
///
/// Throws InputError of several soundings without a time, of a time that none has, and of one
/// without a height.
SoundingTable read_igra(const std::filesystem::path& file, std::string_view text,
                        const std::string& time = "");

}  // namespace diurna
