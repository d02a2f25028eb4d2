#include "materials/modtran/fortran_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

bool parse_fortran(std::string_view text, double& value) {
    std::string plain(text);
    if (plain.starts_with('+')) plain.erase(0, 1);
    for (std::size_t i = 1; i < plain.size(); ++i) {
        char& c = plain[i];
        if (c == 'D' || c == 'd') c = 'E';
        // "1.0000-100": Fortran drops the letter before an exponent of three digits.
        const bool sign = c == '-' || c == '+';
        if (sign &&
            (std::isdigit(static_cast<unsigned char>(plain[i - 1])) || plain[i - 1] == '.')) {
            plain.insert(i, 1, 'E');
            ++i;
        }
        if (plain[i] == '+') plain.erase(i, 1);
    }
    double parsed = 0.0;
    if (parse_number(plain, parsed)) {
        value = parsed;
        return true;
    }
    // Below the smallest double it is as good as zero, if it is a number at all.
    if (plain.find_first_not_of("0123456789.E-") != std::string::npos) return false;
    const std::size_t letter = plain.find('E');
    double mantissa = 0.0, exponent = 0.0;
    if (letter == std::string::npos || !parse_number(plain.substr(0, letter), mantissa) ||
        !parse_number(plain.substr(letter + 1), exponent) || exponent > -300.0) {
        return false;
    }
    value = 0.0;
    return true;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string_view field(std::string_view line, std::size_t first, std::size_t end) {
    if (first >= line.size()) return {};
    return line.substr(first, end - first);
}

LineReader::LineReader(const std::filesystem::path& from, std::string_view text) : file(from) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view found = text.substr(0, end);
        if (found.ends_with('\r')) found.remove_suffix(1);
        line.push_back(found);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

std::string_view LineReader::next(const char* expected) {
    if (done()) {
        throw InputError(fmt::format("{}:{}", file.string(), line.size()),
                         fmt::format("the file ends, expected {}", expected),
                         "the file may be truncated");
    }
    return line[at++];
}

std::string LineReader::where(std::size_t column) const {
    return fmt::format("{}:{}:{}", file.string(), at, column + 1);
}

double LineReader::number(std::size_t first, std::size_t end, const char* what,
                          double if_blank) const {
    const std::string_view text = trimmed(field(line[at - 1], first, end));
    double value = if_blank;
    if (text.empty() && !std::isnan(if_blank)) return if_blank;
    if (!parse_fortran(text, value)) {
        throw InputError(where(first),
                         fmt::format("found '{}', expected {}", text.substr(0, 40), what));
    }
    return value;
}

double LineReader::number(std::size_t first, std::size_t end, const char* what) const {
    return number(first, end, what, std::numeric_limits<double>::quiet_NaN());
}

int LineReader::integer(std::size_t first, std::size_t end, const char* what, int least,
                        int most) const {
    const double value = number(first, end, what);
    if (value != std::floor(value) || value < least || value > most) {
        throw InputError(where(first), fmt::format("found {:g}, expected {} from {} to {}", value,
                                                   what, least, most));
    }
    return static_cast<int>(value);
}

}  // namespace diurna
