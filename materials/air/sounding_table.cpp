#include "materials/air/sounding_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "materials/air/igra.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"

namespace diurna {

namespace {

constexpr std::size_t column_width = 7;

/// The list's columns that are read, in its order, and what plain CSV calls them.
constexpr std::pair<const char*, const char*> listed[] = {{"PRES", "pressure_hPa"},
                                                          {"HGHT", "height_m"},
                                                          {"TEMP", "temperature_C"},
                                                          {"DWPT", "dew_point_C"}};

/// The same of the university's CSV.
constexpr std::pair<const char*, const char*> renamed[] = {
    {"geopotential height_m", "height_m"},
    {"dew point temperature_C", "dew_point_C"},
    {"relative humidity_%", "relative_humidity_percent"},
    {"mixing ratio_g/kg", "mixing_ratio_g_kg"}};

std::string unpadded_field(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

bool is_list_header(const std::string& line) {
    return unpadded_field(line).starts_with("PRES") && line.find("HGHT") != std::string::npos &&
           line.find("TEMP") != std::string::npos && line.find("DWPT") != std::string::npos;
}

/// The cells of a line of the list, each the width of its column and empty where nothing stands.
std::vector<std::string> list_cells(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < std::size(listed); ++i) {
        const std::size_t begin = i * column_width;
        cells.push_back(begin < line.size() ? unpadded_field(line.substr(begin, column_width))
                                            : "");
    }
    return cells;
}

CsvTable read_list(const std::filesystem::path& file, const std::string& text) {
    CsvTable table{.path = file, .header = {}, .rows = {}, .line = {}};
    for (const auto& [theirs, ours] : listed) table.header.emplace_back(ours);
    std::istringstream in(text);
    std::string line;
    int number = 0, headers = 0, dashes = 0;
    while (std::getline(in, line)) {
        ++number;
        if (is_list_header(line)) {
            ++headers;
            dashes = 1;
            continue;
        }
        if (dashes == 1 && line.starts_with("-----")) {
            dashes = 2;
            continue;
        }
        if (dashes < 2) continue;
        const bool row = line.find_first_not_of("0123456789.- \r") == std::string::npos;
        if (!row || unpadded_field(line).empty()) {
            dashes = 0;
            continue;
        }
        table.rows.push_back(list_cells(line));
        table.line.push_back(number);
    }
    if (headers != 1) {
        throw InputError(file.string(),
                         fmt::format("found {} soundings, expected one per file", headers));
    }
    return table;
}

/// Drops rows that lack height or temperature or lie on the one before; those that lie far below or
/// above it stay.
void thin_out(CsvTable& table) {
    constexpr double least_m = 5.0, least_hPa = 0.05;
    const std::size_t height = table.column("height_m"), pressure = table.column("pressure_hPa"),
                      temperature = table.column("temperature_C");
    CsvTable kept = table;
    kept.rows.clear();
    kept.line.clear();
    double last_m = 0.0, last_hPa = 0.0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const auto& cells = table.rows[row];
        if (cells[height].empty() || cells[temperature].empty() || cells[pressure].empty()) {
            continue;
        }
        const double m = table.number(row, height), hPa = table.number(row, pressure);
        if (!kept.rows.empty() &&
            (std::abs(m - last_m) < least_m || std::abs(last_hPa - hPa) < least_hPa)) {
            continue;
        }
        kept.rows.push_back(cells);
        kept.line.push_back(table.line[row]);
        last_m = m;
        last_hPa = hPa;
    }
    table = std::move(kept);
}

}  // namespace

bool is_sounding_list(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (is_list_header(line)) return true;
    }
    return false;
}

SoundingTable read_sounding_table(const std::filesystem::path& file, const std::string& time) {
    const std::string text = read_text(file);
    if (text.starts_with("PK\x03\x04") || text.starts_with("\x1f\x8b")) {
        throw InputError(file.string(), "is compressed", "unpack it and use the file inside");
    }
    if (is_igra(text)) return read_igra(file, text, time);
    if (!time.empty()) {
        throw InputError(file.string(),
                         "is not a file of several soundings; sounding_time needs one",
                         "remove sounding_time");
    }
    if (is_sounding_list(text)) {
        CsvTable table = read_list(file, text);
        thin_out(table);
        return {std::move(table), true};
    }
    if (text.find("%TITLE%") != std::string::npos && text.find("%RAW%") != std::string::npos) {
        throw InputError(file.string(), "is a sounding of SHARPpy, a format that is not supported",
                         "save its columns as CSV: pressure_hPa, height_m, temperature_C, "
                         "dew_point_C");
    }
    CsvTable table = read_csv(file);
    bool theirs = false;
    for (const auto& [name, ours] : renamed) {
        const auto found = std::find(table.header.begin(), table.header.end(), name);
        if (found == table.header.end()) continue;
        *found = ours;
        theirs = true;
    }
    if (theirs) thin_out(table);
    return {std::move(table), theirs};
}

}  // namespace diurna
