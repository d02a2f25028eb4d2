#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/modtran/modtran.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

struct Line {
    std::string text;
    int number;
};

std::vector<Line> lines_of(const std::string& text) {
    std::vector<Line> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.ends_with('\r')) line.pop_back();
        lines.push_back({line, static_cast<int>(lines.size()) + 1});
    }
    return lines;
}

struct Word {
    std::string text;
    std::size_t end;  // one past its last character
};

std::vector<Word> words(const std::string& line) {
    std::vector<Word> found;
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t begin = line.find_first_not_of(" \t", i);
        if (begin == std::string::npos) break;
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        found.push_back({line.substr(begin, end - begin), end});
        i = end;
    }
    return found;
}

double number_at(const fs::path& file, const Line& line, const std::string& text,
                 std::size_t column, const std::string& what) {
    double value = 0.0;
    if (!parse_fortran(text, value)) {
        throw InputError(fmt::format("{}:{}:{}", file.string(), line.number, column + 1),
                         fmt::format("found '{}', expected {}", text.substr(0, 40), what),
                         text.find(',') != std::string::npos ? "the decimal separator is '.'" : "");
    }
    return value;
}

std::string blank_to_underscore(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

bool blank(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos; }

}  // namespace

std::vector<SpectralTable> read_7sc(const fs::path& file) {
    const std::string text = read_text(file, modtran_file_limit);
    const std::vector<Line> lines = lines_of(text);
    std::vector<SpectralTable> tables;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& heading = lines[i].text;
        const std::vector<Word> first = words(heading);
        if (first.empty()) continue;
        SpectralTable table;
        std::size_t axis_end = 0;
        if (first[0].text == "FREQ") {
            axis_end = first[0].end;
        } else if (first[0].text.starts_with("WAVLEN")) {
            const bool nm = heading.find("(NM)") != std::string::npos;
            table.unit = nm ? SpectralUnit::nm : SpectralUnit::um;
            axis_end = std::min(heading.find(')'), heading.size() - 1) + 1;
        } else {
            continue;
        }
        // Headings are right-aligned; two words of one heading are one blank apart.
        std::vector<Word> columns;
        std::size_t gap_from = axis_end;
        for (const Word& word : first) {
            if (word.end <= axis_end) continue;
            const std::size_t begin = word.end - word.text.size();
            if (!columns.empty() && begin - gap_from == 1 &&
                columns.back().text.find('_') == std::string::npos) {
                columns.back().text += "_" + word.text;
                columns.back().end = word.end;
            } else {
                columns.push_back(word);
            }
            gap_from = word.end;
        }
        std::vector<std::vector<double>> value(columns.size());
        std::vector<bool> filled(columns.size(), false);
        bool ended = false;
        for (++i; i < lines.size(); ++i) {
            const std::string& row = lines[i].text;
            if (blank(row)) continue;
            if (row.find("-9999") != std::string::npos && words(row)[0].text.starts_with("-9999")) {
                ended = true;
                break;
            }
            const std::vector<Word> cells = words(row);
            if (cells[0].end > axis_end + 1) {
                if (table.axis.empty()) continue;  // a line of units below the headings
            }
            double axis = 0.0;
            if (!parse_fortran(cells[0].text, axis)) {
                if (table.axis.empty()) continue;
                number_at(file, lines[i], cells[0].text, cells[0].end - cells[0].text.size(),
                          "the spectral variable");
            }
            if (table.axis.size() > 1 &&
                (axis - table.axis.back()) * (table.axis.back() - table.axis.front()) <= 0.0) {
                throw InputError(fmt::format("{}:{}:1", file.string(), lines[i].number),
                                 fmt::format("found {:g} after {:g}, expected one direction", axis,
                                             table.axis.back()));
            }
            table.axis.push_back(axis);
            std::vector<double> values(columns.size(), std::numeric_limits<double>::quiet_NaN());
            for (std::size_t c = 1; c < cells.size(); ++c) {
                std::size_t k = 0;
                while (k < columns.size() && columns[k].end < cells[c].end) ++k;
                if (k == columns.size() || columns[k].end != cells[c].end) {
                    throw InputError(
                        fmt::format("{}:{}:{}", file.string(), lines[i].number, cells[c].end),
                        fmt::format("found '{}', which ends under no heading", cells[c].text));
                }
                values[k] = number_at(file, lines[i], cells[c].text,
                                      cells[c].end - cells[c].text.size(), columns[k].text);
                filled[k] = true;
            }
            for (std::size_t k = 0; k < columns.size(); ++k) value[k].push_back(values[k]);
        }
        if (!ended) {
            throw InputError(fmt::format("{}:{}", file.string(), lines.size()),
                             "the file ends, expected the end mark -9999.",
                             "it may have been cut off");
        }
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (!filled[k]) continue;
            table.name.push_back(columns[k].text);
            table.value.push_back(std::move(value[k]));
        }
        tables.push_back(std::move(table));
    }
    if (tables.empty())
        throw InputError(file.string(), "no line of headings from FREQ or WAVLEN on");
    return tables;
}

FluxTable read_flx(const fs::path& file) {
    const std::string text = read_text(file, modtran_file_limit);
    const std::vector<Line> lines = lines_of(text);
    FluxTable flux;
    std::size_t i = 0;
    const auto at_end = [&] {
        throw InputError(fmt::format("{}:{}", file.string(), lines.size()),
                         "the file ends within its table", "it may have been cut off");
    };
    while (i < lines.size() &&
           lines[i].text.find("SPECTRAL VERTICAL FLUX TABLE") == std::string::npos) {
        ++i;
    }
    if (i == lines.size()) throw InputError(file.string(), "no SPECTRAL VERTICAL FLUX TABLE");
    if (lines[i].text.find("/ NM") != std::string::npos) flux.unit = SpectralUnit::nm;
    if (lines[i].text.find("/ MICRON") != std::string::npos) flux.unit = SpectralUnit::um;
    std::size_t levels = 0;
    for (++i; i < lines.size() && levels == 0; ++i) {
        const auto row = words(lines[i].text);
        if (row.size() >= 2 && row[1].text.starts_with("L") &&
            lines[i].text.find("TABLE COLUMNS") != std::string::npos) {
            const double count = number_at(file, lines[i], row[0].text, 0, "the number of levels");
            if (!(count >= 1 && count <= 1000 && count == std::floor(count))) {
                throw InputError(fmt::format("{}:{}:1", file.string(), lines[i].number),
                                 fmt::format("found {:g}, expected 1 to 1000 levels", count));
            }
            levels = static_cast<std::size_t>(count);
        }
    }
    bool ruled = false;  // altitudes come before the line of dashes that opens the table
    for (; i < lines.size() && !(ruled && flux.altitude_km.size() >= levels); ++i) {
        const auto row = words(lines[i].text);
        for (std::size_t k = 1; k < row.size(); ++k) {
            double km = 0.0;
            if (row[k].text == "KM" && parse_fortran(row[k - 1].text, km)) {
                flux.altitude_km.push_back(km);
            }
        }
        ruled = !row.empty() && row[0].text.starts_with("-------");
    }
    if (i >= lines.size()) at_end();
    if (flux.altitude_km.size() != levels) {
        throw InputError(
            fmt::format("{}:{}", file.string(), lines[i].number),
            fmt::format("found {} altitudes, expected {}", flux.altitude_km.size(), levels));
    }
    flux.up.resize(levels);
    flux.down.resize(levels);
    flux.direct.resize(levels);
    std::vector<double> row;
    bool ended = false;
    for (; i < lines.size(); ++i) {
        if (lines[i].text.find("=====") != std::string::npos) {
            ended = true;
            break;
        }
        for (const Word& word : words(lines[i].text)) {
            row.push_back(
                number_at(file, lines[i], word.text, word.end - word.text.size(), "a flux"));
            if (row.size() < 3 * levels + 1) continue;
            flux.axis.push_back(row[0]);
            for (std::size_t k = 0; k < levels; ++k) {
                flux.up[k].push_back(row[1 + 3 * k]);
                flux.down[k].push_back(row[2 + 3 * k]);
                flux.direct[k].push_back(row[3 + 3 * k]);
            }
            row.clear();
        }
    }
    if (!ended || !row.empty()) at_end();
    return flux;
}

std::vector<Modtran6Table> read_modtran6_json(const fs::path& file) {
    using Json = nlohmann::json;
    Json document;
    try {
        document = Json::parse(read_text(file, modtran_file_limit));
    } catch (const Json::parse_error& error) {
        throw InputError(fmt::format("{}: byte {}", file.string(), error.byte),
                         "not a JSON document");
    }
    std::vector<Modtran6Table> tables;
    try {
        for (const Json& run : document.at("MODTRAN")) {
            if (!run.contains("MODTRANOUTPUT")) continue;
            const std::string name = run.contains("MODTRANINPUT")
                                         ? run["MODTRANINPUT"].value("NAME", std::string())
                                         : "";
            for (const auto& [kind, spectra] : run["MODTRANOUTPUT"].at("SPECTRA").items()) {
                Modtran6Table found{name, kind, {}};
                for (const auto& [key, values] : spectra.items()) {
                    if (!values.is_array()) continue;
                    std::vector<double> column;
                    for (const Json& value : values) {
                        if (!value.is_number()) {
                            throw InputError(fmt::format("{}: {}.{}[{}]", file.string(), kind, key,
                                                         column.size()),
                                             "expected a number");
                        }
                        column.push_back(value.get<double>());
                    }
                    if (key == "FREQ" || key == "WAVELENGTH_NM" || key == "WAVELENGTH") {
                        found.table.unit = key == "FREQ"            ? SpectralUnit::per_cm
                                           : key == "WAVELENGTH_NM" ? SpectralUnit::nm
                                                                    : SpectralUnit::um;
                        found.table.axis = std::move(column);
                    } else {
                        found.table.name.push_back(key);
                        found.table.value.push_back(std::move(column));
                    }
                }
                for (std::size_t c = 0; c < found.table.name.size(); ++c) {
                    if (found.table.value[c].size() != found.table.axis.size()) {
                        throw InputError(
                            fmt::format("{}: {}.{}", file.string(), kind, found.table.name[c]),
                            fmt::format("found {} values, expected {} as in the spectral axis",
                                        found.table.value[c].size(), found.table.axis.size()));
                    }
                }
                tables.push_back(std::move(found));
            }
        }
    } catch (const Json::exception& error) {
        throw InputError(file.string(), fmt::format("not MODTRAN's JSON: {}", error.what()));
    }
    if (tables.empty()) throw InputError(file.string(), "no MODTRANOUTPUT with SPECTRA");
    return tables;
}

std::vector<SpectralTable> read_modtran6_csv(const fs::path& file) {
    const std::vector<Line> lines = lines_of(read_text(file, modtran_file_limit));
    const auto cells = [](const std::string& line) {
        std::vector<Word> found;
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t end = std::min(line.find(',', begin), line.size());
            const std::vector<Word> inside = words(line.substr(begin, end - begin));
            std::string joined;
            for (const Word& word : inside) joined += (joined.empty() ? "" : "_") + word.text;
            found.push_back({joined, end});
            begin = end + 1;
        }
        while (!found.empty() && found.back().text.empty()) found.pop_back();
        return found;
    };
    std::vector<SpectralTable> tables;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].text.find("case index") == std::string::npos) continue;
        if (i + 6 >= lines.size()) {
            throw InputError(fmt::format("{}:{}", file.string(), lines[i].number),
                             "the file ends within a case", "it may have been cut off");
        }
        const auto upper = cells(lines[i + 4].text), lower = cells(lines[i + 5].text);
        SpectralTable table;
        if (!lower.empty()) {
            if (lower[0].text == "nm") table.unit = SpectralUnit::nm;
            if (lower[0].text == "um" || lower[0].text == "micron") table.unit = SpectralUnit::um;
        }
        for (std::size_t c = 1; c < std::max(upper.size(), lower.size()); ++c) {
            std::string name = c < upper.size() ? upper[c].text : "";
            if (c < lower.size() && !lower[c].text.empty()) {
                name += (name.empty() ? "" : "_") + lower[c].text;
            }
            table.name.push_back(blank_to_underscore(name));
        }
        table.value.resize(table.name.size());
        bool ended = false;
        for (i += 6; i < lines.size(); ++i) {
            if (lines[i].text.find('}') != std::string::npos) {
                ended = true;
                break;
            }
            if (blank(lines[i].text)) continue;
            const auto row = cells(lines[i].text);
            if (row.size() != table.name.size() + 1) {
                throw InputError(fmt::format("{}:{}", file.string(), lines[i].number),
                                 fmt::format("found {} cells, expected {} as in the headings",
                                             row.size(), table.name.size() + 1));
            }
            for (std::size_t c = 0; c < row.size(); ++c) {
                const double value =
                    number_at(file, lines[i], row[c].text, row[c].end - row[c].text.size(),
                              c == 0 ? "the spectral variable" : table.name[c - 1]);
                (c == 0 ? table.axis : table.value[c - 1]).push_back(value);
            }
        }
        if (!ended) {
            throw InputError(fmt::format("{}:{}", file.string(), lines.size()),
                             "the file ends within a case", "it may have been cut off");
        }
        tables.push_back(std::move(table));
    }
    if (tables.empty()) throw InputError(file.string(), "no 'case index' in the file");
    return tables;
}

SpectralTable read_spectral_csv(const fs::path& file) {
    const CsvTable csv = read_csv(file);
    SpectralTable table;
    std::size_t axis = csv.header.size();
    for (const auto& [name, unit] : {std::pair{"wavelength_um", SpectralUnit::um},
                                     std::pair{"wavelength_nm", SpectralUnit::nm},
                                     std::pair{"wavenumber_per_cm", SpectralUnit::per_cm}}) {
        if (!csv.has(name)) continue;
        axis = csv.column(name);
        table.unit = unit;
    }
    if (axis == csv.header.size()) {
        throw InputError(file.string(),
                         "no column wavelength_um, wavelength_nm or wavenumber_per_cm");
    }
    for (std::size_t c = 0; c < csv.header.size(); ++c) {
        std::vector<double> column;
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            column.push_back(csv.number(row, c));
            if (c == axis && row > 0 && !(column[row] > column[row - 1])) {
                throw InputError(csv.where(row, c), "expected the spectral variable to ascend");
            }
        }
        if (c == axis) {
            table.axis = std::move(column);
        } else {
            table.name.push_back(csv.header[c]);
            table.value.push_back(std::move(column));
        }
    }
    return table;
}

}  // namespace diurna
