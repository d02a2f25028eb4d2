#include "materials/modtran/tape7.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "materials/modtran/tape7_columns.hpp"

namespace diurna {

namespace {

/// Which of the two files MODTRAN writes.
enum class Kind { plain, convolved };

Kind kind_of(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".7sc" || ending == ".scn" ? Kind::convolved : Kind::plain;
}

/// The cards of the header, up to the headings.
Tape7Run read_cards(LineReader& source) {
    Tape7Run run;
    const std::string_view card1 = source.next("a tape7 header");
    const std::string_view flags = trimmed(field(card1, 0, 2));
    run.lowtran = flags.empty() || flags.find_first_not_of("0123456789") == std::string_view::npos;
    run.model = source.integer(run.lowtran ? 0 : 3, 5, "MODEL", 0, 8);
    run.path_type = source.integer(5, 10, "ITYPE", 1, 4);
    run.emission = source.integer(10, 15, "IEMSCT", 0, 3);
    run.multiple_scattering = source.integer(15, 20, "IMULT", -1, 1);
    run.ground_temperature = source.number(65, 73, "TPTEMP [K]", 0.0);
    source.next("card 2");
    run.haze = source.integer(0, 5, "IHAZE", -1, 10);
    run.visibility_km = source.number(30, 40, "VIS [km]", 0.0);
    source.next("card 2A");
    source.next("card 2B");
    const std::string_view name = source.next("the model's name");
    run.model_name = trimmed(field(name, 5, name.size()));
    source.next("card 3");
    run.h1_km = source.number(0, 10, "H1 [km]");
    run.h2_km = source.number(10, 20, "H2 [km]");
    run.zenith_deg = source.number(20, 30, "ANGLE [deg]");
    run.range_km = source.number(30, 40, "RANGE [km]");
    source.next("card 3A1");
    source.next("card 3A2");
    source.next("card 4");
    run.first_per_cm = source.number(0, 10, "V1 [cm-1]");
    run.last_per_cm = source.number(10, 20, "V2 [cm-1]");
    run.step_per_cm = source.number(20, 30, "DV [cm-1]");
    run.width_per_cm = source.number(30, 40, "FWHM [cm-1]", 0.0);
    source.next("card 5");
    return run;
}

/// A table's columns and the unit of its first.
struct Layout {
    std::vector<Tape7Column> columns;
    bool over_um = false;  // else over cm⁻¹
};

Layout read_headings(LineReader& source, const Tape7Run& run, Kind kind) {
    const std::string_view heading = source.next("column headings");
    const std::string_view start = trimmed(heading);
    const bool over_um = kind == Kind::convolved && start.starts_with("WAVLEN(MCRN)");
    if (!over_um && !start.starts_with("FREQ")) {
        throw InputError(
            source.where(0),
            fmt::format("found '{}', expected column headings from FREQ {}on", start.substr(0, 40),
                        kind == Kind::convolved ? "or WAVLEN(MCRN) " : ""),
            start.starts_with("WAVLEN") ? "let MODTRAN convolve over cm-1 or µm" : "");
    }
    if (kind == Kind::convolved) return {convolved_columns(heading), over_um};
    if (run.lowtran) return {lowtran_columns(run.emission)};
    return {modtran_columns(run.emission, heading, source)};
}

/// The number of a column in the line last read; NaN where it may be blank and is.
double cell(const LineReader& source, std::string_view line, std::size_t begin,
            const Tape7Column& column) {
    const std::string_view text = trimmed(field(line, begin, column.end));
    double value = std::numeric_limits<double>::quiet_NaN();
    if (text.empty() && !column.may_be_blank) {
        throw InputError(source.where(begin),
                         fmt::format("blank, expected {} in columns {} to {}", column.name,
                                     begin + 1, column.end),
                         line.size() < column.end ? "the line may be truncated" : "");
    }
    if (!text.empty() && !parse_fortran(text, value)) {
        throw InputError(
            source.where(begin),
            fmt::format("found '{}', expected {} in columns {} to {}", text.substr(0, 40),
                        column.name, begin + 1, column.end),
            text.find(',') != std::string_view::npos ? "the decimal separator is '.'" : "");
    }
    return value;
}

void read_row(const LineReader& source, std::string_view line, const Layout& layout,
              Tape7Table& table) {
    std::vector<double>& axis = table.wavenumber;
    std::size_t begin = 0;
    for (std::size_t c = 0; c < layout.columns.size(); ++c) {
        const double value = cell(source, line, begin, layout.columns[c]);
        if (c == 0) {
            if (!axis.empty() && !(value > axis.back())) {
                throw InputError(source.where(0),
                                 fmt::format("found {:g} {} after {:g}, expected "
                                             "them to ascend",
                                             value, layout.over_um ? "µm" : "cm-1", axis.back()));
            }
            axis.push_back(value);
        } else {
            table.value[c - 1].push_back(value);
        }
        begin = layout.columns[c].end;
    }
    const std::string_view rest = trimmed(field(line, begin, line.size()));
    if (!rest.empty()) {
        throw InputError(source.where(begin),
                         fmt::format("found '{}' beyond the last column", rest.substr(0, 40)));
    }
}

/// A table over µm to one over cm⁻¹: L per cm⁻¹ = L per µm · 10⁴ / ν².
void to_wavenumbers(Tape7Table& table) {
    for (double& x : table.wavenumber) x = wavenumber_of_um(x);
    for (std::size_t c = 0; c < table.name.size(); ++c) {
        constexpr std::array<std::string_view, 4> plain = {"TOT_TRANS", "DEPTH", "DIR_EM",
                                                           "BBODY_T[K]"};
        if (std::find(plain.begin(), plain.end(), table.name[c]) == plain.end()) {
            for (std::size_t i = 0; i < table.wavenumber.size(); ++i) {
                table.value[c][i] *= 1e4 / (table.wavenumber[i] * table.wavenumber[i]);
            }
        }
        std::reverse(table.value[c].begin(), table.value[c].end());
    }
    std::reverse(table.wavenumber.begin(), table.wavenumber.end());
}

Tape7Run read_run(LineReader& source, Kind kind) {
    Tape7Run run = read_cards(source);
    const Layout layout = read_headings(source, run, kind);
    Tape7Table& table = run.table;
    for (std::size_t c = 1; c < layout.columns.size(); ++c) {
        table.name.push_back(layout.columns[c].name);
    }
    table.value.resize(table.name.size());
    while (true) {
        const std::string_view line = source.next("the end mark -9999.");
        if (trimmed(line).starts_with("-9999")) break;
        if (trimmed(line).empty()) continue;
        read_row(source, line, layout, table);
    }
    if (table.wavenumber.empty()) {
        throw InputError(source.where(0), "found a run without data rows");
    }
    if (layout.over_um) to_wavenumbers(table);
    return run;
}

std::vector<Tape7Run> read_runs(const std::filesystem::path& file, const std::string& text,
                                Kind kind) {
    LineReader source(file, text);
    std::vector<Tape7Run> runs;
    while (!source.done()) {
        if (trimmed(source.line[source.at]).empty()) {
            ++source.at;
            continue;
        }
        runs.push_back(read_run(source, kind));
    }
    if (runs.empty()) throw InputError(file.string(), "is empty, expected a tape7");
    return runs;
}

}  // namespace

bool Tape7Table::has(std::string_view wanted) const {
    return std::find(name.begin(), name.end(), wanted) != name.end();
}

const std::vector<double>& Tape7Table::column(std::string_view wanted) const {
    const auto found = std::find(name.begin(), name.end(), wanted);
    if (found == name.end()) {
        throw InputError("MODTRAN table", fmt::format("no column '{}'", wanted),
                         did_you_mean(wanted, name));
    }
    return value[static_cast<std::size_t>(found - name.begin())];
}

std::vector<Tape7Run> read_tape7(const std::filesystem::path& file) {
    return read_runs(file, read_text(file, modtran_file_limit), kind_of(file));
}

std::vector<Tape7Run> read_tape7_text(const std::filesystem::path& file, const std::string& text) {
    return read_runs(file, text, Kind::plain);
}

Tape7Spectra spectra_of(const Tape7Run& run) {
    Tape7Spectra spectra;
    const Tape7Table& table = run.table;
    const auto radiance = [&](const char* name, std::size_t row) {
        if (!table.has(name)) return 0.0;
        const double value = table.column(name)[row];
        return std::isnan(value) ? 0.0 : per_um_from_modtran(value, table.wavenumber[row]);
    };
    for (std::size_t k = table.wavenumber.size(); k-- > 0;) {
        spectra.wavelength_um.push_back(um_of_wavenumber(table.wavenumber[k]));
        spectra.transmittance.push_back(table.column("TOT_TRANS")[k]);
        spectra.thermal.push_back(radiance("PTH_THRML", k));
        spectra.scattered.push_back(radiance("SOL_SCAT", k));
    }
    return spectra;
}

}  // namespace diurna
