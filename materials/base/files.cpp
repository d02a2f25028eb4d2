#include "materials/base/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "materials/base/error.hpp"

namespace diurna {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path, std::size_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw InputError(path.string(), "no such file");
    if (!fs::is_regular_file(status)) throw InputError(path.string(), "not a regular file");
    const std::uintmax_t size = fs::file_size(path, code);
    if (code || size > limit) {
        throw InputError(path.string(), "file has " + std::to_string(size) +
                                            " bytes, expected at most " + std::to_string(limit));
    }
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw InputError(path.string(), "cannot be read");
    return std::move(text).str();
}

void write_whole_file(const fs::path& path, std::span<const std::byte> bytes) {
    const fs::path temporary = path.string() + ".part";
    const auto fail = [&](const char* what) {
        const std::string reason = std::strerror(errno);
        ::unlink(temporary.c_str());
        throw std::runtime_error(path.string() + ": " + what + ": " + reason);
    };
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) fail("cannot create");
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
        if (written < 0) {
            ::close(file);
            fail("cannot write");
        }
        done += static_cast<std::size_t>(written);
    }
    if (::fsync(file) != 0) {
        ::close(file);
        fail("cannot flush");
    }
    if (::close(file) != 0) fail("cannot close");
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot rename into place");
}

void write_whole_file(const fs::path& path, std::string_view text) {
    write_whole_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

fs::path data_folder() {
    const char* named = std::getenv("DIURNA_DATA");
    return named != nullptr ? fs::path(named) : fs::path(DIURNA_SOURCE_DIR) / "materials";
}

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Splits at commas; a cell may stand in double quotes, within which commas do not count.
std::vector<std::string> cells(std::string_view line) {
    std::vector<std::string> found;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (line[i] != ',' || quoted)) continue;
        std::string_view cell = trimmed(line.substr(begin, i - begin));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
            cell = cell.substr(1, cell.size() - 2);
        }
        found.emplace_back(cell);
        begin = i + 1;
    }
    return found;
}

}  // namespace

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
        throw InputError(where(row, column) + ": " + header.at(column),
                         "found '" + cell.substr(0, 40) + "', expected a finite number",
                         cell.find(',') != std::string::npos ? "the decimal separator is '.'" : "");
    }
    return value;
}

CsvTable read_csv(const fs::path& path) {
    const std::string text = read_text(path);
    CsvTable table{.path = path, .header = {}, .rows = {}, .line = {}};
    int line_number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        if (++line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
        if (line.empty() || line.front() == '#') continue;
        std::vector<std::string> row = cells(line);
        if (table.header.empty()) {
            table.header = std::move(row);
            continue;
        }
        if (row.size() != table.header.size()) {
            throw InputError(path.string() + ":" + std::to_string(line_number),
                             "found " + std::to_string(row.size()) + " cells, expected " +
                                 std::to_string(table.header.size()) + " as in the header");
        }
        table.rows.push_back(std::move(row));
        table.line.push_back(line_number);
    }
    if (table.header.empty())
        throw InputError(path.string(), "empty table, expected a header line");
    return table;
}

}  // namespace diurna
