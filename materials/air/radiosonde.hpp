#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "materials/air/profile.hpp"

namespace diurna {

/// A profile from a radiosonde's table: levels from the ground up. Formats: the University of
/// Wyoming's text list or CSV, a sounding of the Integrated Global Radiosonde Archive (see
/// materials/air/sounding_table.hpp), or plain CSV with a header and '#' comments:
///
/// height_m or height_km              above the sea; ascending, or descending
/// pressure_hPa                       optional: without it hydrostatic from the lowest level, whose
///                                    row must have a pressure (others may be empty)
/// temperature_C or temperature_K
/// relative_humidity_percent, dew_point_C or mixing_ratio_g_kg; empty: as in `above` there
///
/// Levels at which the pressure rises or the height falls for a moment are skipped and noted
/// (sounding_levels.hpp). Gases other than water, and everything above the last level, come from
/// the AFGL profile `above`; if it is "", from the seasonal profile for the air measured 3 km above
/// the lowest level (seasonal_profile.hpp). Temperature and pressure join it over 5 km. 2 to 5000
/// levels. Throws InputError with file:line:column for invalid values.
struct Sounding {
    Profile profile;
    std::size_t levels = 0;  // number of the profile's levels that were measured
};
/// time  of the sounding, in a file of several (materials/air/igra.hpp); "": a file of one
Sounding read_sounding(const std::filesystem::path& file, const std::string& above = "",
                       const std::string& time = "");
/// Its profile.
Profile read_radiosonde(const std::filesystem::path& file, const std::string& above = "",
                        const std::string& time = "");

/// An AFGL name, or the path of a radiosonde file where the name ends in ".csv", ".txt" or ".html".
Profile named_profile(const std::string& name);

}  // namespace diurna
