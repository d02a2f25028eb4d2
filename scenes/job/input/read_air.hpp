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

/// The air between surface and eye: an AFGL profile, the seasonal one or a radiosonde's, adjusted
/// to the weather at the ground, or none, or a table of paths from a file, the same at every
/// instant.
struct AirInput {
    std::filesystem::path table_file;             // "": no table
    std::shared_ptr<const TabulatedPaths> table;  // null: none
    std::filesystem::path sounding_file;          // "": no radiosonde
    std::shared_ptr<const Profile> sounding;      // null: none
    bool vacuum = false;
    bool by_season = true;  // no AFGL profile named: scenes/job/world/upper_air.hpp
    std::string profile = "season";
    std::string aerosol = "rural";
    double visibility_km = 23.0;
    double co2_ppm = todays_co2_ppm;
    double cloud_base_km = 2.0;   // above the ground
    double cloud_depth_km = 0.3;  // from base to top
    /// The heat balance takes unmeasured sun and sky from this air; else from the broadband
    /// formulas of [sky]. Pictures use the light of the heat balance in both cases.
    bool drives_heat = true;
};

/// The section [atmosphere].
AirInput read_air(const Section& section);

/// The formulas' aerosol, if the section [sky] does not name it: from the air's visibility.
void take_haze(const AirInput& air, const Section& section, ClearSky& sky);

/// The range of a band or cube that is used through the air.
struct SeenRange {
    std::string name;
    double from_um, to_um;
};

/// A table of paths must hold the bins of every range and, as tables have no scattered sun, no
/// range may begin below 3 µm: otherwise mistakes of `section`. Air without a table passes.
void check_table_bands(const Section& section, const AirInput& air,
                       std::span<const SeenRange> ranges);

}  // namespace diurna
