#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// The text of a regular file of at most `limit` bytes. Throws InputError naming the file if it is
/// missing, not a regular file, unreadable or larger.
std::string read_text(const std::filesystem::path& path, std::size_t limit = 64u << 20);

/// Writes a whole file or none: into a temporary name beside it, flushed to disk, then renamed.
/// Throws std::runtime_error with path and reason; the target is then as it was.
void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// Where the project's own data lie (`materials/` with its tables and spectra): the environment's
/// DIURNA_DATA if set, else the source tree this program was built from.
std::filesystem::path data_folder();

/// A table read from comma-separated text. Lines starting with '#' are comments and empty lines
/// are passed over; the first other line is the header. Every mistake names file, line and column.
struct CsvTable {
    std::filesystem::path path;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  // (row, column), trimmed; as wide as the header
    std::vector<int> line;                       // (row) line number in the file, from 1

    bool has(std::string_view column) const;
    /// Index of a column; throws InputError with the nearest name if it is absent.
    std::size_t column(std::string_view name) const;
    /// "file:line:column", the place of a cell.
    std::string where(std::size_t row, std::size_t column) const;
    /// The finite number in a cell. "1,5", "nan", "inf", "1e999" and trailing text are refused.
    double number(std::size_t row, std::size_t column) const;
};
CsvTable read_csv(const std::filesystem::path& path);

/// A finite number that takes up the whole text, or nothing; independent of the locale.
bool parse_number(std::string_view text, double& value);

}  // namespace diurna
