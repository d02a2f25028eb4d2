#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// What MODTRAN 4 to 6 and LOWTRAN7 write, as tables. Every reader refuses damaged input with
/// file:line:column; files are limited to 256 MB.
inline constexpr std::size_t modtran_file_limit = 256u << 20;

enum class SpectralUnit { per_cm, nm, um };

/// Named columns over a spectral variable, as printed: values in the file's own units.
struct SpectralTable {
    SpectralUnit unit = SpectralUnit::per_cm;
    std::vector<double> axis;                // (row)
    std::vector<std::string> name;           // (column) "TOT_TRANS", ...
    std::vector<std::vector<double>> value;  // (column)(row); NaN where the file has blanks

    bool has(std::string_view column) const;
    /// Throws InputError with the nearest name if there is none.
    const std::vector<double>& column(std::string_view column) const;
};

/// One run of a tape7: what its header echoes and its table.
///
/// emission  IEMSCT: 0 transmittance, 1 thermal, 2 thermal and sun, 3 direct sun
/// range_km  true slant range; for ITYPE 1 the only geometry, with h1_km, that counts
struct Tape7Run {
    bool lowtran = false;
    int model = 0, path_type = 0, emission = 0, multiple_scattering = 0;
    double ground_temperature = 0.0;  // [K] TPTEMP
    int haze = 0;                     // IHAZE
    double visibility_km = 0.0;
    std::string model_name;
    double h1_km = 0.0, h2_km = 0.0, zenith_deg = 0.0, range_km = 0.0;
    double first_per_cm = 0.0, last_per_cm = 0.0, step_per_cm = 0.0, width_per_cm = 0.0;
    SpectralTable table;
};

/// tape7, .tp7, .fl7: all runs of a file, IEMSCT 0 to 3, CRLF or LF, cut by column position.
/// Names have underscores whatever the version prints; for LOWTRAN7 they are MODTRAN's where the
/// meaning is the same (TOT_TRANS, PTH_THRML, SOL_SCAT, SING_SCAT, GRND_RFLT, DRCT_RFLT,
/// TOTAL_RAD). Throws InputError for a file without its end mark, text where a number belongs, NaN,
/// values that straddle columns, wavenumbers that do not ascend, or blanks where none may be.
std::vector<Tape7Run> read_tape7(const std::filesystem::path& file);
/// The same of a text at hand; `file` names it in messages.
std::vector<Tape7Run> read_tape7_text(const std::filesystem::path& file, const std::string& text);

/// .7sc and tape7.scn: the convolved tape7, whose variable may be cm⁻¹, nm or µm. Columns end where
/// their headings do; headings without data below are left out.
std::vector<SpectralTable> read_7sc(const std::filesystem::path& file);

/// .flx: fluxes through horizontal planes at levels.
struct FluxTable {
    SpectralUnit unit = SpectralUnit::per_cm;   // of `axis`; fluxes are W cm⁻² per it
    std::vector<double> altitude_km;            // (level), 0 the lowest
    std::vector<double> axis;                   // (row)
    std::vector<std::vector<double>> up, down;  // (level)(row), diffuse
    std::vector<std::vector<double>> direct;    // (level)(row), sun on the horizontal
};
FluxTable read_flx(const std::filesystem::path& file);

/// MODTRAN 6 JSON output: one table per case and kind ("TRANSMITTANCE", "RADIANCE", ...).
struct Modtran6Table {
    std::string name, kind;
    SpectralTable table;
};
std::vector<Modtran6Table> read_modtran6_json(const std::filesystem::path& file);
/// MODTRAN 6 CSV output (CSVPRNT): one table per case; names as printed, "combin trans" etc.
std::vector<SpectralTable> read_modtran6_csv(const std::filesystem::path& file);
/// Plain CSV: a column wavelength_um, wavelength_nm or wavenumber_per_cm, then any named columns.
SpectralTable read_spectral_csv(const std::filesystem::path& file);

/// A path's spectra in this program's units, ascending in wavelength.
struct FilePath {
    std::vector<double> wavelength_um;
    std::vector<double> transmittance;
    std::vector<double> thermal;  // [W m⁻² sr⁻¹ µm⁻¹] of the air; zero if the run has none
    std::vector<double> scattered;  // of the sun, by the air
};
FilePath path_of(const Tape7Run& run);

/// L per µm = L per cm⁻¹ · ν² · 10⁻⁴; with W cm⁻² turned to W m⁻² the powers of ten cancel.
constexpr double per_um_from_modtran(double per_cm_and_cm2, double wavenumber) {
    return per_cm_and_cm2 * wavenumber * wavenumber;
}

/// A number as Fortran prints it: "1.2345E-03", "1.2345D-03", "1.0000-100". False for blanks
/// inside, stars, NaN and anything else.
bool parse_fortran(std::string_view text, double& value);

}  // namespace diurna
