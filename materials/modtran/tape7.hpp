#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// Named columns over ascending wavenumbers: radiances per cm⁻¹ and cm², as MODTRAN prints them.
struct Tape7Table {
    std::vector<double> wavenumber;          // (row) [cm⁻¹]
    std::vector<std::string> name;           // (column) "TOT_TRANS", ...
    std::vector<std::vector<double>> value;  // (column)(row); NaN where the file has blanks

    bool has(std::string_view column) const;
    /// Throws InputError with the nearest name if the column does not exist.
    const std::vector<double>& column(std::string_view column) const;
};

/// One run of a tape7 of MODTRAN 4 to 6 or LOWTRAN7: its header's values and its table.
struct Tape7Run {
    bool lowtran = false;
    int model = 0;
    int path_type = 0;  // ITYPE: 1 level, 2 between heights, 3 to space
    int emission = 0;   // IEMSCT: 0 transmittance, 1 thermal, 2 thermal and sun, 3 direct sun
    int multiple_scattering = 0;
    double ground_temperature = 0.0;  // [K] TPTEMP
    int haze = 0;                     // IHAZE
    double visibility_km = 0.0;
    std::string model_name;
    double h1_km = 0.0, h2_km = 0.0, zenith_deg = 0.0;
    double range_km = 0.0;  // slant; with h1_km the only geometry used for level paths
    double first_per_cm = 0.0, last_per_cm = 0.0, step_per_cm = 0.0, width_per_cm = 0.0;
    Tape7Table table;
};

/// Limit for files: 256 MB.
inline constexpr std::size_t modtran_file_limit = 256u << 20;

/// All runs of a tape7, .tp7 or .fl7 (IEMSCT 0 to 3, CRLF or LF), cut by column position; of a .7sc
/// or .scn, which is a tape7 convolved with a slit, by the ends of its headings.
///
/// Names have underscores for every version; for LOWTRAN7 and convolved runs they are the tape7's
/// where the meaning is the same (TOT_TRANS, PTH_THRML, SOL_SCAT, SING_SCAT, GRND_RFLT, DRCT_RFLT,
/// TOTAL_RAD). A convolved table over µm is converted to wavenumbers; one over nm, whose radiances
/// have another unit, is refused.
///
/// Throws InputError with file:line:column for a file without its end mark, text in place of a
/// number, NaN, values across column borders, wavenumbers that do not ascend, or blanks in required
/// fields.
std::vector<Tape7Run> read_tape7(const std::filesystem::path& file);
/// The same for a tape7 in memory; `file` names it in messages.
std::vector<Tape7Run> read_tape7_text(const std::filesystem::path& file, const std::string& text);

/// A run's spectra in this program's units, ascending in wavelength.
struct Tape7Spectra {
    std::vector<double> wavelength_um;
    std::vector<double> transmittance;
    std::vector<double> thermal;    // [W m⁻² sr⁻¹ µm⁻¹] of the air; zero if absent
    std::vector<double> scattered;  // of the sun, by the air
};
Tape7Spectra spectra_of(const Tape7Run& run);

/// L per µm = L per cm⁻¹ · ν² · 10⁻⁴; with W cm⁻² turned to W m⁻² the powers of ten cancel.
constexpr double per_um_from_modtran(double per_cm_and_cm2, double wavenumber) {
    return per_cm_and_cm2 * wavenumber * wavenumber;
}

}  // namespace diurna
