#include "thermal/weather_file/separators.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace diurna {

namespace {

/// Lines without their ends.
std::vector<std::string_view> lines_in(std::string_view text) {
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

/// Cells as written, quotes included; several blanks count as one.
std::vector<std::string_view> cells_in(std::string_view line, char separator) {
    std::vector<std::string_view> cells;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (line[i] != separator || quoted)) continue;
        if (separator != ' ' || i > begin) cells.push_back(line.substr(begin, i - begin));
        begin = i + 1;
    }
    return cells;
}

/// "12,5", "-0,25".
bool is_decimal_comma(std::string_view cell) {
    const auto first = cell.find_first_not_of(" +-");
    if (first == std::string_view::npos) return false;
    cell = cell.substr(first);
    return std::count(cell.begin(), cell.end(), ',') == 1 && cell.front() != ',' &&
           cell.find_first_not_of("0123456789,eE+- ") == std::string_view::npos;
}

std::string rewritten(std::string_view line, char separator) {
    std::string out;
    bool first = true;
    for (const std::string_view cell : cells_in(line, separator)) {
        if (!first) out += ',';
        first = false;
        if (is_decimal_comma(cell)) {
            std::string number(cell);
            std::replace(number.begin(), number.end(), ',', '.');
            out += number;
        } else if (cell.find(',') != std::string_view::npos && cell.front() != '"') {
            out.append("\"").append(cell).append("\"");
        } else {
            out += cell;
        }
    }
    return out;
}

bool is_row(std::string_view line) {
    return line.find_first_not_of(" \t") != std::string_view::npos && line.front() != '#';
}

/// The separator of a table whose header has no comma; 0: it has, or no other.
char separator_of(const std::vector<std::string_view>& lines, std::size_t header) {
    const std::string_view names = lines[header];
    if (names.find(',') != std::string_view::npos) return 0;
    for (const char mark : {';', '\t'}) {
        if (names.find(mark) != std::string_view::npos) return mark;
    }
    const std::size_t words = cells_in(names, ' ').size();
    const auto first =
        std::find_if(lines.begin() + std::ptrdiff_t(header) + 1, lines.end(), is_row);
    const bool even = first != lines.end() && cells_in(*first, ' ').size() == words;
    return words > 1 && even ? ' ' : 0;
}

}  // namespace

std::string with_commas(std::string_view text, int skip, std::string& found) {
    found.clear();
    const std::vector<std::string_view> lines = lines_in(text);
    std::size_t header = std::size_t(std::max(0, skip));
    while (header < lines.size() && !is_row(lines[header])) ++header;
    const char separator = header < lines.size() ? separator_of(lines, header) : '\0';
    if (separator == 0) return std::string(text);
    found = separator == ';' ? "';'" : separator == '\t' ? "tabs" : "blanks";
    std::string out;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        out += i < header || !is_row(lines[i]) ? std::string(lines[i])
                                               : rewritten(lines[i], separator);
        out += '\n';
    }
    return out;
}

}  // namespace diurna
