#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "materials/air/profile.hpp"
#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/section.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna {

/// The air between surface and eye: an AFGL profile, that of the season or a radiosonde's, made to
/// meet the weather at the ground, or none, or a table of paths from a file, the same at every
/// instant.
struct AirInput {
    std::filesystem::path table_file;             // "": no table
    std::shared_ptr<const TabulatedPaths> table;  // null: none
    std::filesystem::path sounding_file;          // "": no radiosonde
    std::shared_ptr<const Profile> sounding;      // null: none
    bool vacuum = false;
    bool by_season = true;  // no AFGL profile is named: scenes/world/upper_air.hpp
    std::string profile = "season";
    std::string aerosol = "rural";
    double visibility_km = 23.0;
    double co2_ppm = todays_co2_ppm;
    double cloud_base_km = 2.0;   // above the ground
    double cloud_depth_km = 0.3;  // from base to top
    /// The heat balance takes what nobody measured of sun and sky from this air; else from the
    /// broadband formulas of [sky]. Pictures have the light of the heat balance either way.
    bool drives_heat = true;
};

/// The section [atmosphere].
AirInput read_air(const Section& section);

/// The formulas' aerosol, where the section [sky] does not name it: that of the air's visibility.
void take_haze(const AirInput& air, const Section& section, ClearSky& sky);

/// A band or a cube's range that somebody is to look through the air in.
struct SeenRange {
    std::string name;
    double from_um, to_um;
};

/// A table of paths has to hold the bins of every range and, as tables have no scattered sun, none
/// may begin below 3 µm: mistakes of `section` otherwise. Air without a table passes.
void check_table_bands(const Section& section, const AirInput& air,
                       std::span<const SeenRange> ranges);

}  // namespace diurna
