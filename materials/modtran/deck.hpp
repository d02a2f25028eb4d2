#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/air/profile.hpp"

namespace diurna {

/// One run of MODTRAN: its inputs from a scene. Values are checked when it is written.
struct ModtranDeck {
    enum class Emission { thermal = 1, thermal_and_sun = 2 };
    enum class PathType { level = 1, between_heights = 2, to_space = 3 };

    Emission emission = Emission::thermal;
    bool multiple_scattering = false;
    std::string model = "US76";                     // AFGL name; replaced by a profile below
    std::optional<Profile> profile = std::nullopt;  // radiosonde or the scene's air
    std::string aerosol = "rural";  // none, rural, maritime, urban, tropospheric, fog_*, desert
    double visibility_km = 23.0;    // 0.1 to 300
    double rain_mm_h = 0.0;         // 0 to 300
    double wind_m_s = 0.0;          // for desert aerosol, 0 to 50
    double co2_ppm = 425.0;
    double ground_km = 0.0;           // -0.5 to 6
    double ground_temperature = 0.0;  // [K]; 0: the air's
    double albedo = 0.0;              // 0 to 1
    PathType path = PathType::level;
    double h1_km = 0.0, h2_km = 0.0;  // 0 to 100; h2 for paths between heights
    double zenith_deg = 90.0;         // at h1, 0 up; for paths to space
    double range_km = 1.0;            // level paths and paths between heights
    double sun_zenith_deg = 45.0;     // with sun
    double sun_azimuth_deg = 0.0;     // from the line of sight
    int day_of_year = 94;
    double first_per_cm = 500.0, last_per_cm = 5000.0, step_per_cm = 5.0, width_per_cm = 10.0;
};

/// tape5 for MODTRAN 5 (CARD 1 to CARD 5 in their Fortran formats). Several decks share a file
/// (IRPT 1). Throws InputError for a value out of its range or too wide for its field.
std::string write_tape5(const std::vector<ModtranDeck>& decks);

}  // namespace diurna
