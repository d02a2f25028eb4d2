#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// Texts of fixed columns as Fortran prints them.
namespace diurna {

/// A number: "1.2345E-03", "1.2345D-03", "1.0000-100". False for inner blanks, stars, NaN and
/// anything else.
bool parse_fortran(std::string_view text, double& value);

/// The text without leading and trailing blanks.
std::string_view trimmed(std::string_view text);
/// Columns [first, end) of a line; shorter lines are padded with blanks.
std::string_view field(std::string_view line, std::size_t first, std::size_t end);

/// Reads the lines of a text (LF or CRLF) in order, with the position of each in its file.
struct LineReader {
    LineReader(const std::filesystem::path& file, std::string_view text);

    const std::filesystem::path& file;
    std::vector<std::string_view> line;
    std::size_t at = 0;  // the next line

    bool done() const { return at >= line.size(); }
    /// The next line. Throws InputError where the text ends, naming what was `expected`.
    std::string_view next(const char* expected);
    /// "file:line:column" of a column of the line last read, from 0.
    std::string where(std::size_t column) const;

    /// The number in columns [first, end) of the last line read. Throws InputError for anything
    /// else; a blank is `if_blank`, unless that is NaN.
    double number(std::size_t first, std::size_t end, const char* what, double if_blank) const;
    double number(std::size_t first, std::size_t end, const char* what) const;
    int integer(std::size_t first, std::size_t end, const char* what, int least, int most) const;
};

}  // namespace diurna
