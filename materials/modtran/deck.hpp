#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/air/profile.hpp"
#include "materials/modtran/modtran.hpp"

namespace diurna {

/// One run of MODTRAN: what of a scene its input needs. Values are checked when it is written.
struct ModtranDeck {
    enum class Emission { transmittance = 0, thermal = 1, thermal_and_sun = 2, direct_sun = 3 };
    enum class PathType { level = 1, between_heights = 2, to_space = 3 };

    std::string name = "diurna";
    Emission emission = Emission::thermal;
    bool multiple_scattering = false;
    std::string model = "US76";                     // AFGL name; a profile below takes its place
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
    double zenith_deg = 90.0;         // at h1, 0 up; for paths to space and direct sun
    double range_km = 1.0;            // level paths and paths between heights
    double sun_zenith_deg = 45.0;     // with sun
    double sun_azimuth_deg = 0.0;     // from the line of sight
    int day_of_year = 94;
    double first_per_cm = 500.0, last_per_cm = 5000.0, step_per_cm = 5.0, width_per_cm = 10.0;
};

/// tape5 for MODTRAN 5 (CARD 1 to CARD 5 in their Fortran formats). Several decks share a file
/// (IRPT 1). Throws InputError for a value out of its range or too wide for its field.
std::string write_tape5(const std::vector<ModtranDeck>& decks);
/// The same for MODTRAN 6, JSON.
std::string write_modtran6_json(const std::vector<ModtranDeck>& decks);

/// A program that reads `tape5` (or, for MODTRAN 6, the JSON file it is given) in its working
/// folder and writes `tape7` (or `tape7.csv`-like files) there.
///
/// executable  absolute path, from the command line or DIURNA_MODTRAN; never from a scene file
struct ModtranRunner {
    std::filesystem::path executable;
    std::filesystem::path data;  // MODTRAN_DATA of its environment; empty: not set
    std::chrono::milliseconds time_limit{600'000};
    std::uintmax_t output_limit = 512u << 20;  // bytes, all files of its folder together
};

/// From the command line's word, else the environment's DIURNA_MODTRAN; nothing if neither names
/// one. Throws InputError for a name that is not the absolute path of an executable file.
std::optional<ModtranRunner> modtran_runner(const std::string& command_line_word);

/// Runs the program on an input in a new temporary folder that is removed afterwards: no shell, its
/// own process group, standard input empty, standard output dropped, an environment of PATH, LANG
/// and MODTRAN_DATA alone. Returns the text of `result_file`.
/// Throws std::runtime_error if it fails, takes longer or writes more than allowed (it and its
/// children are then killed), or leaves no result.
std::string run_modtran(const ModtranRunner& runner, const std::string& input_file,
                        const std::string& input, const std::string& result_file);

/// Runs the decks as one tape5 and reads what comes back: one run of its tape7 a deck, in order.
/// Throws std::runtime_error besides if their numbers differ, InputError for a damaged tape7.
std::vector<Tape7Run> run_decks(const ModtranRunner& runner, const std::vector<ModtranDeck>& decks);

}  // namespace diurna
