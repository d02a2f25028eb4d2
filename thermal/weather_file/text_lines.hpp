#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// Byte order mark at the start of some texts.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// A text file split into lines, without line ends and byte order mark. Not copyable: the lines
/// refer to `text`.
struct TextLines {
    std::filesystem::path path;
    std::string text;
    std::vector<std::string_view> line;

    explicit TextLines(const std::filesystem::path& file);
    TextLines(const TextLines&) = delete;
    TextLines& operator=(const TextLines&) = delete;

    /// "file:line" of a line; the argument counts from 0, the text from 1.
    std::string where(std::size_t at) const;
};

/// The words of a line, separated by blanks.
std::vector<std::string_view> words_of(std::string_view line);
/// Throws InputError(where) unless the word is a finite number.
double number_in(std::string_view word, const std::string& where);
/// NaN at or above a format's code for missing values.
double unless_missing(double value, double code);

}  // namespace diurna
