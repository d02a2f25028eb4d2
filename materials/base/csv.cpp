#include "materials/base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/syntax_hints.hpp"

namespace diurna {

namespace {

std::string_view unpadded(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

constexpr std::size_t most_columns = 4096, most_line = 1 << 20;

/// Throws InputError for more columns than any table has, or two of a name.
void check_header(const std::vector<std::string>& header, const std::string& where) {
    if (header.size() > most_columns) {
        throw InputError(where, "found " + std::to_string(header.size()) +
                                    " columns, expected at most " + std::to_string(most_columns));
    }
    std::vector<std::string> sorted = header;
    std::sort(sorted.begin(), sorted.end());
    const auto again = std::adjacent_find(
        sorted.begin(), sorted.end(),
        [](const std::string& a, const std::string& b) { return a == b && !a.empty(); });
    if (again != sorted.end()) {
        throw InputError(where, "has column '" + again->substr(0, 40) + "' twice",
                         "keep only one of them");
    }
}

/// Throws InputError for a header of one cell that is parted otherwise than by commas.
void check_separator(const std::vector<std::string>& header, const std::string& where) {
    if (header.size() != 1) return;
    for (const auto& [mark, name] : {std::pair{';', "';'"}, {'\t', "a tab"}}) {
        if (header.front().find(mark) == std::string::npos) continue;
        throw InputError(where, std::string("cells are separated by ") + name + ", expected ','",
                         "save it with commas between cells and '.' as decimal separator");
    }
}

}  // namespace

std::vector<std::string> csv_cells(std::string_view line) {
    std::vector<std::string> found;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (line[i] != ',' || quoted)) continue;
        std::string_view cell = unpadded(line.substr(begin, i - begin));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
            cell = cell.substr(1, cell.size() - 2);
        }
        found.emplace_back(cell);
        begin = i + 1;
    }
    return found;
}

bool parse_number(std::string_view text, double& value) {
    const char* const end = text.data() + text.size();
    const auto [stop, code] = std::from_chars(text.data(), end, value);
    return code == std::errc{} && stop == end && std::isfinite(value);
}

bool CsvTable::has(std::string_view name) const {
    return std::find(header.begin(), header.end(), name) != header.end();
}

std::size_t CsvTable::column(std::string_view name) const {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
        throw InputError(path.string(), "no column '" + std::string(name) + "' in the header",
                         did_you_mean(name, header));
    }
    return static_cast<std::size_t>(found - header.begin());
}

std::string CsvTable::where(std::size_t row, std::size_t column) const {
    return path.string() + ":" + std::to_string(line.at(row)) + ":" + std::to_string(column + 1);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    double value = 0.0;
    const std::string& cell = rows.at(row).at(column);
    if (!parse_number(cell, value)) {
        const std::string small = small_letters(cell);
        const bool none = small == "n/a" || small == "na" || small == "nan" || small == "null" ||
                          small == "none" || small == "m" || small == "-" || small == "--";
        throw InputError(where(row, column) + ": " + header.at(column),
                         "found '" + cell.substr(0, 40) + "', expected a finite number",
                         none ? "leave the cell empty if the value is missing"
                         : cell.find(',') != std::string::npos ? "the decimal separator is '.'"
                                                               : "");
    }
    return value;
}

CsvTable read_csv(const std::filesystem::path& path, int skip) {
    return csv_table(path, read_text(path), skip);
}

CsvTable csv_table(const std::filesystem::path& path, std::string_view text, int skip) {
    if (is_utf16(text)) throw InputError(path.string(), utf16_problem, utf16_hint);
    CsvTable table{.path = path, .header = {}, .rows = {}, .line = {}};
    int line_number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = unpadded(text.substr(begin, end - begin));
        begin = end + 1;
        if (++line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        if (line_number <= skip || line.empty() || line.front() == '#') continue;
        const std::string where = path.string() + ":" + std::to_string(line_number);
        if (line.size() > most_line) {
            throw InputError(where, "a line of " + std::to_string(line.size()) +
                                        " bytes, expected at most " + std::to_string(most_line));
        }
        if (line.find('\0') != std::string_view::npos) {
            throw InputError(where, "found a byte of value 0: the file is not text");
        }
        std::vector<std::string> row = csv_cells(line);
        if (table.header.empty()) {
            table.header = std::move(row);
            table.header_line = line_number;
            check_separator(table.header, where);
            check_header(table.header, where);
            continue;
        }
        if (row.size() != table.header.size()) {
            throw InputError(where,
                             "found " + std::to_string(row.size()) + " cells, expected " +
                                 std::to_string(table.header.size()) + " as in the header",
                             row.size() > table.header.size()
                                 ? "',' separates cells; the decimal separator is '.'"
                                 : "");
        }
        table.rows.push_back(std::move(row));
        table.line.push_back(line_number);
    }
    if (table.header.empty())
        throw InputError(path.string(), "empty table, expected a header line");
    return table;
}

}  // namespace diurna
