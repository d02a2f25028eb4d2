#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "materials/air/profile.hpp"

namespace diurna {

/// A profile from a radiosonde's table: levels from the ground up. The University of Wyoming's text
/// list or CSV, a sounding of the Integrated Global Radiosonde Archive (materials/air/
/// sounding_table.hpp), or plain CSV with a header and '#' comments:
///
/// height_m or height_km              above the sea; ascending, or descending
/// pressure_hPa                       optional: else hydrostatic from the lowest level's, which
///                                    must then be given in its row (others may be empty)
/// temperature_C or temperature_K
/// relative_humidity_percent, dew_point_C or mixing_ratio_g_kg; empty: as in `above` there
///
/// Levels at which the pressure rises or the height falls for a moment are skipped and noted
/// (sounding_levels.hpp). Gases besides water, and everything above the last level, are those of
/// the AFGL profile `above`, or where that is "" of the season by the measured air 3 km above the
/// lowest level (seasonal_profile.hpp); temperature and pressure join it over 5 km. Two levels or
/// more, up to 5000. Throws InputError with file:line:column for what cannot be.
struct Sounding {
    Profile profile;
    std::size_t levels = 0;  // of the profile, those that were measured
};
/// time  of the sounding in a file of several (materials/air/igra.hpp); "": it holds one
Sounding read_sounding(const std::filesystem::path& file, const std::string& above = "",
                       const std::string& time = "");
/// Its profile.
Profile read_radiosonde(const std::filesystem::path& file, const std::string& above = "",
                        const std::string& time = "");

/// An AFGL name, or the path of a radiosonde file where the name ends in ".csv", ".txt" or ".html".
Profile named_profile(const std::string& name);

}  // namespace diurna
