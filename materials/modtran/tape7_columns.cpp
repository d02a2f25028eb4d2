#include "materials/modtran/tape7_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

void add_evenly(std::vector<Tape7Column>& columns, std::initializer_list<const char*> names,
                std::size_t first_end, std::size_t width) {
    for (const char* name : names) {
        columns.push_back({name, first_end});
        first_end += width;
    }
}

/// The names of a transmittance run, from the two heading lines, joined where columns end.
std::vector<Tape7Column> transmittance_columns(std::string_view upper, std::string_view lower) {
    std::vector<Tape7Column> columns = {{"FREQ", 8}};
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
std::vector<Tape7Column> radiance_columns(std::string_view heading, const LineReader& source) {
    static const std::vector<std::string> known = {
        "FREQ",      "TOT_TRANS", "PTH_THRML", "THRML_SCT", "SURF_EMIS", "SOL_SCAT",
        "SING_SCAT", "GRND_RFLT", "DRCT_RFLT", "TOTAL_RAD", "REF_SOL",   "SOL@OBS",
        "DEPTH",     "DIR_EM",    "TOA_SUN",   "BBODY_T[K]"};
    std::vector<Tape7Column> columns;
    std::size_t from = 0;
    for (const std::string& name : known) {
        std::string spaced = name;  // MODTRAN 4 has blanks for underscores
        std::replace(spaced.begin(), spaced.end(), '_', ' ');
        const std::size_t place = std::min(heading.find(name, from), heading.find(spaced, from));
        if (place == std::string_view::npos) {
            if (columns.size() >= 10) continue;  // older versions lack the last ones
            throw InputError(source.where(from), fmt::format("found no heading {} in '{}'", name,
                                                             trimmed(heading).substr(0, 60)));
        }
        const bool solar = name == "THRML_SCT" || name == "SOL_SCAT" || name == "SING_SCAT" ||
                           name == "DRCT_RFLT" || name == "REF_SOL" || name == "SOL@OBS" ||
                           name == "TOA_SUN";
        from = place + name.size();
        columns.push_back({name, from, solar});
    }
    return columns;
}

}  // namespace

std::vector<Tape7Column> lowtran_columns(int emission) {
    std::vector<Tape7Column> columns = {{"FREQ", 7}};
    if (emission == 0) {
        add_evenly(columns,
                   {"TOT_TRANS", "H2O_TRANS", "CO2+_TRANS", "O3_TRANS", "TRACE_TRANS", "N2_CONT",
                    "H2O_CONT", "MOLEC_SCAT", "AER-HYD_TRANS", "HNO3_TRANS", "AER-HYD_abTRNS"},
                   15, 8);
    } else {
        columns.push_back({"TOT_TRANS", 15});
    }
    if (emission == 1) columns.push_back({"PTH_THRML", 24});
    if (emission == 2) {
        add_evenly(columns,
                   {"PTH_THRML", "SOL_SCAT", "SING_SCAT", "GRND_RFLT", "DRCT_RFLT", "TOTAL_RAD"},
                   24, 9);
        add_evenly(columns, {"SUN_GROUND_OBS_TRANS", "SUN_OBS_TRANS"}, 77, 8);
    }
    if (emission == 3) add_evenly(columns, {"SOL_TR", "SOLAR"}, 24, 9);
    columns.push_back({"DEPTH", 105});  // alone at the end of the line, without a heading
    return columns;
}

std::vector<Tape7Column> modtran_columns(int emission, std::string_view heading,
                                         LineReader& source) {
    if (emission == 0) {
        return transmittance_columns(heading, source.next("the second line of headings"));
    }
    if (emission == 3) {
        return {{"FREQ", 8}, {"TOT_TRANS", 16}, {"SOL_TR", 25}, {"SOLAR", 34}, {"DEPTH", 105}};
    }
    return radiance_columns(heading, source);
}

std::vector<Tape7Column> convolved_columns(std::string_view heading) {
    std::vector<Tape7Column> columns;
    const std::size_t bracket = heading.find(')');
    std::size_t last_end = 0;
    for (std::size_t at = 0; at < heading.size();) {
        const std::size_t begin = heading.find_first_not_of(' ', at);
        if (begin == std::string_view::npos) break;
        std::size_t end = std::min(heading.find(' ', begin), heading.size());
        const bool first = columns.empty();
        if (first && bracket != std::string_view::npos) end = bracket + 1;  // "WAVLEN (NM)"
        const std::string word(heading.substr(begin, end - begin));
        const bool second_word = columns.size() > 1 && begin - last_end == 1 &&
                                 columns.back().name.find('_') == std::string::npos;
        if (second_word) {
            columns.back().name += "_" + word;
            columns.back().end = end;
        } else {
            columns.push_back({word == "TRANS" ? "TOT_TRANS" : word, end, !first});
        }
        at = last_end = end;
    }
    return columns;
}

}  // namespace diurna
