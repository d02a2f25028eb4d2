#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// A table read from comma-separated text. Lines starting with '#' and empty lines are skipped; the
/// first other line is the header. Every mistake names file, line and column.
struct CsvTable {
    std::filesystem::path path;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  // (row, column), trimmed; as wide as the header
    std::vector<int> line;                       // (row) line number in the file, from 1
    int header_line = 1;                         // line number in the file, from 1

    bool has(std::string_view column) const;
    /// Index of a column; throws InputError with the nearest name if it is absent.
    std::size_t column(std::string_view name) const;
    /// "file:line:column", the place of a cell.
    std::string where(std::size_t row, std::size_t column) const;
    /// The finite number in a cell. "1,5", "nan", "inf", "1e999" and trailing text are refused.
    double number(std::size_t row, std::size_t column) const;
};
/// The first `skip` lines of the file are skipped.
CsvTable read_csv(const std::filesystem::path& path, int skip = 0);
/// The same for a text in memory; `path` names it in messages.
CsvTable csv_table(const std::filesystem::path& path, std::string_view text, int skip = 0);

/// The trimmed cells of a line; a cell may be in double quotes, with commas inside.
std::vector<std::string> csv_cells(std::string_view line);

/// A finite number that fills the whole text, or nothing; independent of the locale.
bool parse_number(std::string_view text, double& value);

}  // namespace diurna
