#include "materials/base/syntax_hints.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace diurna {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

std::string_view without_blanks(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// What stands behind a number at the value's begin.
std::string_view behind_number(std::string_view value) {
    const std::size_t sign = value.starts_with('-') || value.starts_with('+') ? 1 : 0;
    std::size_t end = sign;
    while (end < value.size() && (is_digit(value[end]) || value[end] == '.')) ++end;
    return end == sign ? std::string_view{} : value.substr(end);
}

}  // namespace

std::string syntax_hint(std::string_view line) {
    constexpr std::string_view curly[] = {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E",
                                          "\xE2\x80\x98", "\xE2\x80\x99"};
    for (const std::string_view quote : curly) {
        if (line.find(quote) != line.npos) return "enclose text in straight quotes (\")";
    }
    const std::size_t equals = line.find('=');
    if (equals == line.npos) {
        const bool table = std::count(line.begin(), line.end(), ',') > 1;
        return table ? "check that the file is TOML: diurna inspect FILE" : "";
    }
    const std::string_view value = without_blanks(line.substr(equals + 1));
    if (value.empty()) return "a value is expected after '='";
    if (value.find('\\') != value.npos && value.front() == '"') {
        return "a backslash in quotes begins an escape: use '/' between folders";
    }
    if (value.find("//") != value.npos && value.find('"') == value.npos) {
        return "use '#' for comments";
    }
    if (value.ends_with(';')) return "remove the ';' at the end";
    if (std::count(value.begin(), value.end(), '"') % 2 == 1) {
        return "the closing quote is missing";
    }
    const std::string_view rest = behind_number(value);
    if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1]))
        return "the decimal separator is '.'";
    if (const std::string_view word = without_blanks(rest); !word.empty() && is_letter(word[0])) {
        return "write numbers without units: the suffix of the key is the unit, as in radius_m";
    }
    if (value == "True" || value == "False" || value == "TRUE" || value == "FALSE") {
        return "write true and false in lower case";
    }
    const bool listed = value.front() == '[' && value.find('"') == value.npos;
    if (is_letter(value.front()) || listed) {
        return "enclose text in quotes: \"8-12\", [\"3-5\", \"8-12\"]";
    }
    return "";
}

bool is_utf16(std::string_view text) {
    return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

}  // namespace diurna
