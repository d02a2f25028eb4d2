#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// What some programs begin a text with.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// A text file cut into lines, without their ends and the mark before the first. Not to be copied:
/// the lines lie in `text`.
struct TextLines {
    std::filesystem::path path;
    std::string text;
    std::vector<std::string_view> line;

    explicit TextLines(const std::filesystem::path& file);
    TextLines(const TextLines&) = delete;
    TextLines& operator=(const TextLines&) = delete;

    /// "file:line" of a line, counted from 0 here and from 1 there.
    std::string where(std::size_t at) const;
};

/// What stands between blanks.
std::vector<std::string_view> words_of(std::string_view line);
/// Throws InputError(where) unless the word is a finite number.
double number_in(std::string_view word, const std::string& where);
/// NaN at or above a format's code for missing values.
double unless_missing(double value, double code);

}  // namespace diurna
