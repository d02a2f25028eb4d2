#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/modtran/modtran.hpp"

namespace diurna {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Lines of a text, without their ends (LF or CRLF).
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Text being read, and where.
struct Source {
    const std::filesystem::path& file;
    std::vector<std::string_view> line;
    std::size_t at = 0;

    std::string where(std::size_t line_index, std::size_t column) const {
        return fmt::format("{}:{}:{}", file.string(), line_index + 1, column + 1);
    }
    bool done() const { return at >= line.size(); }
    std::string_view next(const char* expected) {
        if (done()) {
            throw InputError(fmt::format("{}:{}", file.string(), line.size()),
                             fmt::format("the file ends, expected {}", expected),
                             "it may have been cut off");
        }
        return line[at++];
    }
};

/// Columns [first, end) of a line; shorter lines count as blank.
std::string_view field(std::string_view line, std::size_t first, std::size_t end) {
    if (first >= line.size()) return {};
    return line.substr(first, end - first);
}

/// A header's number; `fallback` where it is blank.
double header_number(const Source& source, std::size_t first, std::size_t end, const char* what,
                     double fallback = nothing) {
    const std::size_t index = source.at - 1;
    const std::string_view text = trimmed(field(source.line[index], first, end));
    double value = fallback;
    if (text.empty() && !std::isnan(fallback)) return fallback;
    if (!parse_fortran(text, value)) {
        throw InputError(source.where(index, first),
                         fmt::format("found '{}', expected {}", text.substr(0, 40), what));
    }
    return value;
}

int header_integer(const Source& source, std::size_t first, std::size_t end, const char* what,
                   int least, int most) {
    const double value = header_number(source, first, end, what);
    if (value != std::floor(value) || value < least || value > most) {
        throw InputError(
            source.where(source.at - 1, first),
            fmt::format("found {:g}, expected {} from {} to {}", value, what, least, most));
    }
    return static_cast<int>(value);
}

struct Column {
    std::string name;
    std::size_t end;  // one past its last character
    bool may_be_blank = false;
};

std::vector<Column> evenly(std::initializer_list<const char*> names, std::size_t first_end,
                           std::size_t width) {
    std::vector<Column> columns;
    for (const char* name : names) {
        columns.push_back({name, first_end});
        first_end += width;
    }
    return columns;
}

std::vector<Column> lowtran_columns(int emission) {
    std::vector<Column> columns = {{"FREQ", 7}};
    const auto append = [&](std::vector<Column> more) {
        columns.insert(columns.end(), more.begin(), more.end());
    };
    if (emission == 0) {
        append(evenly({"TOT_TRANS", "H2O_TRANS", "CO2+_TRANS", "O3_TRANS", "TRACE_TRANS", "N2_CONT",
                       "H2O_CONT", "MOLEC_SCAT", "AER-HYD_TRANS", "HNO3_TRANS", "AER-HYD_abTRNS"},
                      15, 8));
        columns.push_back({"DEPTH", 105});
        // The depth follows the last transmittance at once in transmittance runs.
        columns.back().end = 105;
        return columns;
    }
    columns.push_back({"TOT_TRANS", 15});
    if (emission == 1) {
        columns.push_back({"PTH_THRML", 24});
    } else if (emission == 2) {
        append(evenly({"PTH_THRML", "SOL_SCAT", "SING_SCAT", "GRND_RFLT", "DRCT_RFLT", "TOTAL_RAD"},
                      24, 9));
        append(evenly({"SUN_GROUND_OBS_TRANS", "SUN_OBS_TRANS"}, 77, 8));
    } else {
        append(evenly({"SOL_TR", "SOLAR"}, 24, 9));
    }
    columns.push_back({"DEPTH", 105});
    return columns;
}

/// The names of a transmittance run, from the two heading lines, joined where columns end.
std::vector<Column> transmittance_columns(std::string_view upper, std::string_view lower) {
    std::vector<Column> columns = {{"FREQ", 8}};
    const std::size_t longest = std::max(upper.size(), lower.size());
    std::size_t begin = 8;
    for (std::size_t end = 15; begin < longest && columns.size() < 64;) {
        if (columns.size() == 12) end += 1;  // -LOG_COMBIN has eight characters
        std::string name(trimmed(field(upper, begin, end)));
        const std::string below(trimmed(field(lower, begin, end)));
        if (name.empty() && below.empty()) break;
        if (!name.empty() && !below.empty()) name += '_';
        name += below;
        columns.push_back({name, end});
        begin = end;
        end += 7;
    }
    // Headings are wider than some columns and overlap: the first twelve have fixed names.
    constexpr std::array<const char*, 13> fixed = {
        "FREQ",        "TOT_TRANS",      "H2O_TRANS", "UMIX_TRANS", "O3_TRANS",
        "TRACE_TRANS", "N2_CONT",        "H2O_CONT",  "MOLEC_SCAT", "AER+CLD_TRANS",
        "HNO3_TRANS",  "AER+CLD_abTRNS", "DEPTH"};
    for (std::size_t i = 0; i < std::min(fixed.size(), columns.size()); ++i) {
        columns[i].name = fixed[i];
    }
    return columns;
}

/// Radiance runs: columns end where their headings do.
std::vector<Column> radiance_columns(const Source& source, std::string_view heading) {
    static const std::vector<std::string> known = {
        "FREQ",      "TOT_TRANS", "PTH_THRML", "THRML_SCT", "SURF_EMIS", "SOL_SCAT",
        "SING_SCAT", "GRND_RFLT", "DRCT_RFLT", "TOTAL_RAD", "REF_SOL",   "SOL@OBS",
        "DEPTH",     "DIR_EM",    "TOA_SUN",   "BBODY_T[K]"};
    std::string text(heading);
    std::vector<Column> columns;
    std::size_t from = 0;
    for (const std::string& name : known) {
        std::string spaced = name;  // MODTRAN 4 has blanks for underscores
        std::replace(spaced.begin(), spaced.end(), '_', ' ');
        std::size_t place = std::min(text.find(name, from), text.find(spaced, from));
        if (place == std::string::npos) {
            if (columns.size() >= 10) continue;  // older versions lack the last ones
            throw InputError(
                source.where(source.at - 1, from),
                fmt::format("found no heading {} in '{}'", name, trimmed(heading).substr(0, 60)));
        }
        const bool solar = name == "THRML_SCT" || name == "SOL_SCAT" || name == "SING_SCAT" ||
                           name == "DRCT_RFLT" || name == "REF_SOL" || name == "SOL@OBS" ||
                           name == "TOA_SUN";
        from = place + name.size();
        columns.push_back({name, from, solar});
    }
    return columns;
}

void read_row(const Source& source, const std::vector<Column>& columns, SpectralTable& table) {
    const std::size_t index = source.at - 1;
    const std::string_view line = source.line[index];
    std::size_t begin = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        // The optical depth of LOWTRAN stands alone at the end of the line, without a heading.
        const std::size_t end = columns[c].end;
        const std::string_view text = trimmed(field(line, begin, end));
        double value = nothing;
        if (text.empty() && !columns[c].may_be_blank) {
            throw InputError(source.where(index, begin),
                             fmt::format("blank, expected {} in columns {} to {}", columns[c].name,
                                         begin + 1, end),
                             line.size() < end ? "the line may have been cut off" : "");
        }
        if (!text.empty() && !parse_fortran(text, value)) {
            throw InputError(
                source.where(index, begin),
                fmt::format("found '{}', expected {} in columns {} to {}", text.substr(0, 40),
                            columns[c].name, begin + 1, end),
                text.find(',') != std::string_view::npos ? "the decimal separator is '.'" : "");
        }
        if (c == 0) {
            if (!table.axis.empty() && !(value > table.axis.back())) {
                throw InputError(source.where(index, 0),
                                 fmt::format("found {:g} cm-1 after {:g}, expected them to ascend",
                                             value, table.axis.back()));
            }
            table.axis.push_back(value);
        } else {
            table.value[c - 1].push_back(value);
        }
        begin = end;
    }
    const std::string_view rest = trimmed(field(line, begin, line.size()));
    if (!rest.empty()) {
        throw InputError(source.where(index, begin),
                         fmt::format("found '{}' beyond the last column", rest.substr(0, 40)));
    }
}

Tape7Run read_run(Source& source) {
    Tape7Run run;
    const std::string_view card1 = source.next("a tape7 header");
    const std::string_view flags = trimmed(field(card1, 0, 2));
    run.lowtran = flags.empty() || flags.find_first_not_of("0123456789") == std::string_view::npos;
    run.model = header_integer(source, run.lowtran ? 0 : 3, 5, "MODEL", 0, 8);
    run.path_type = header_integer(source, 5, 10, "ITYPE", 1, 4);
    run.emission = header_integer(source, 10, 15, "IEMSCT", 0, 3);
    run.multiple_scattering = header_integer(source, 15, 20, "IMULT", -1, 1);
    run.ground_temperature = header_number(source, 65, 73, "TPTEMP [K]", 0.0);
    source.next("card 2");
    run.haze = header_integer(source, 0, 5, "IHAZE", -1, 10);
    run.visibility_km = header_number(source, 30, 40, "VIS [km]", 0.0);
    source.next("card 2A");
    source.next("card 2B");
    const std::string_view name = source.next("the model's name");
    run.model_name = trimmed(field(name, 5, name.size()));
    source.next("card 3");
    run.h1_km = header_number(source, 0, 10, "H1 [km]");
    run.h2_km = header_number(source, 10, 20, "H2 [km]");
    run.zenith_deg = header_number(source, 20, 30, "ANGLE [deg]");
    run.range_km = header_number(source, 30, 40, "RANGE [km]");
    source.next("card 3A1");
    source.next("card 3A2");
    source.next("card 4");
    run.first_per_cm = header_number(source, 0, 10, "V1 [cm-1]");
    run.last_per_cm = header_number(source, 10, 20, "V2 [cm-1]");
    run.step_per_cm = header_number(source, 20, 30, "DV [cm-1]");
    run.width_per_cm = header_number(source, 30, 40, "FWHM [cm-1]", 0.0);
    source.next("card 5");
    const std::string_view heading = source.next("column headings");
    if (trimmed(heading).substr(0, 4) != "FREQ") {
        throw InputError(source.where(source.at - 1, 0),
                         fmt::format("found '{}', expected column headings from FREQ on",
                                     trimmed(heading).substr(0, 40)));
    }
    std::vector<Column> columns;
    if (run.lowtran) {
        columns = lowtran_columns(run.emission);
    } else if (run.emission == 0) {
        columns = transmittance_columns(heading, source.next("the second line of headings"));
    } else if (run.emission == 3) {
        columns = {{"FREQ", 8}, {"TOT_TRANS", 16}, {"SOL_TR", 25}, {"SOLAR", 34}, {"DEPTH", 105}};
    } else {
        columns = radiance_columns(source, heading);
    }
    for (std::size_t c = 1; c < columns.size(); ++c) run.table.name.push_back(columns[c].name);
    run.table.value.resize(run.table.name.size());
    while (true) {
        const std::string_view line = source.next("the end mark -9999.");
        if (trimmed(line).starts_with("-9999")) break;
        if (trimmed(line).empty()) continue;
        read_row(source, columns, run.table);
    }
    if (run.table.axis.empty()) {
        throw InputError(source.where(source.at - 1, 0), "a run without a row of data");
    }
    return run;
}

}  // namespace

bool parse_fortran(std::string_view text, double& value) {
    std::string plain(text);
    if (plain.starts_with('+')) plain.erase(0, 1);
    for (std::size_t i = 1; i < plain.size(); ++i) {
        char& c = plain[i];
        if (c == 'D' || c == 'd') c = 'E';
        // "1.0000-100": Fortran drops the letter before an exponent of three digits.
        const bool sign = c == '-' || c == '+';
        if (sign &&
            (std::isdigit(static_cast<unsigned char>(plain[i - 1])) || plain[i - 1] == '.')) {
            plain.insert(i, "E");
            ++i;
        }
        if (plain[i] == '+') plain.erase(i, 1);
    }
    double parsed = 0.0;
    if (parse_number(plain, parsed)) {
        value = parsed;
        return true;
    }
    // Below the smallest double it is as good as zero, if it is a number at all.
    if (plain.find_first_not_of("0123456789.E-") != std::string::npos) return false;
    const std::size_t letter = plain.find('E');
    double mantissa = 0.0, exponent = 0.0;
    if (letter == std::string::npos || !parse_number(plain.substr(0, letter), mantissa) ||
        !parse_number(plain.substr(letter + 1), exponent) || exponent > -300.0) {
        return false;
    }
    value = 0.0;
    return true;
}

bool SpectralTable::has(std::string_view wanted) const {
    return std::find(name.begin(), name.end(), wanted) != name.end();
}

const std::vector<double>& SpectralTable::column(std::string_view wanted) const {
    const auto found = std::find(name.begin(), name.end(), wanted);
    if (found == name.end()) {
        throw InputError("MODTRAN table", fmt::format("no column '{}'", wanted),
                         did_you_mean(wanted, name));
    }
    return value[static_cast<std::size_t>(found - name.begin())];
}

std::vector<Tape7Run> read_tape7(const std::filesystem::path& file) {
    return read_tape7_text(file, read_text(file, modtran_file_limit));
}

std::vector<Tape7Run> read_tape7_text(const std::filesystem::path& file, const std::string& text) {
    Source source{file, lines_of(text)};
    std::vector<Tape7Run> runs;
    while (!source.done()) {
        if (trimmed(source.line[source.at]).empty()) {
            ++source.at;
            continue;
        }
        runs.push_back(read_run(source));
    }
    if (runs.empty()) throw InputError(file.string(), "empty, expected a tape7");
    return runs;
}

FilePath path_of(const Tape7Run& run) {
    FilePath path;
    const std::size_t rows = run.table.axis.size();
    const auto radiance = [&](const char* name, std::size_t row) {
        if (!run.table.has(name)) return 0.0;
        const double value = run.table.column(name)[row];
        return std::isnan(value) ? 0.0 : per_um_from_modtran(value, run.table.axis[row]);
    };
    for (std::size_t k = rows; k-- > 0;) {
        path.wavelength_um.push_back(1e4 / run.table.axis[k]);
        path.transmittance.push_back(run.table.column("TOT_TRANS")[k]);
        path.thermal.push_back(radiance("PTH_THRML", k));
        path.scattered.push_back(radiance("SOL_SCAT", k));
    }
    return path;
}

}  // namespace diurna
