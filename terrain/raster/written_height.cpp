#include "terrain/raster/written_height.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "materials/base/csv.hpp"
#include "terrain/raster/height_unit.hpp"

namespace diurna {

namespace {

constexpr double inch = 0.0254;  // [m]

std::string_view without_blanks(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// A number's characters at the front of a text.
std::string_view leading_digits(std::string_view text) {
    return text.substr(0, std::min(text.find_first_not_of("0123456789.,+-"), text.size()));
}

/// "12,5" with its comma as a decimal point; "1,200" is none, as it may be a thousand.
std::optional<double> number_of(std::string_view digits) {
    std::string number(digits);
    if (number.starts_with('+')) number.erase(0, 1);
    const std::size_t comma = number.find(',');
    if (comma != std::string::npos) {
        if (number.size() - comma == 4) return std::nullopt;
        number[comma] = '.';
    }
    double value = 0.0;
    return parse_number(number, value) ? std::optional(value) : std::nullopt;
}

std::string with_plain_marks(std::string_view text) {
    std::string plain(text);
    for (const auto& [mark, ours] :
         {std::pair<std::string, const char*>{"′", "'"}, {"’", "'"}, {"″", "\""}, {"''", "\""}}) {
        for (std::size_t at; (at = plain.find(mark)) != std::string::npos;) {
            plain.replace(at, mark.size(), ours);
        }
    }
    return plain;
}

}  // namespace

std::optional<double> written_height(std::string_view text) {
    const std::string plain = with_plain_marks(text);
    std::string_view rest = without_blanks(plain);
    const std::string_view digits = leading_digits(rest);
    const auto value = number_of(digits);
    if (!value) return std::nullopt;
    rest = without_blanks(rest.substr(digits.size()));
    if (rest.empty()) return value;
    const std::string_view unit =
        without_blanks(rest.substr(0, std::min(rest.find_first_of("0123456789"), rest.size())));
    const auto feet = height_unit(unit);
    const auto whole = height_unit(rest);
    if (whole) return *value * whole->metres;
    if (!feet || feet->metres < 0.3 || feet->metres > 0.31) return std::nullopt;
    rest = without_blanks(rest.substr(std::size_t(unit.data() - rest.data()) + unit.size()));
    const std::string_view inches = leading_digits(rest);
    const auto more = number_of(inches);
    rest = without_blanks(rest.substr(inches.size()));
    if (!more || (rest != "\"" && rest != "in" && rest != "inches")) return std::nullopt;
    return *value * feet->metres + *more * inch;
}

}  // namespace diurna
