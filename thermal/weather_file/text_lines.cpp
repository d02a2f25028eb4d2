#include "thermal/weather_file/text_lines.hpp"

#include <algorithm>
#include <limits>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "thermal/weather_file/weather_text.hpp"

namespace diurna {

TextLines::TextLines(const std::filesystem::path& file) : path(file), text(weather_text(file)) {
    std::string_view all = text;
    if (all.starts_with(byte_order_mark)) all.remove_prefix(byte_order_mark.size());
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find('\n', begin), all.size());
        std::string_view one = all.substr(begin, end - begin);
        if (one.ends_with('\r')) one.remove_suffix(1);
        line.push_back(one);
        begin = end + 1;
    }
}

std::string TextLines::where(std::size_t at) const {
    return path.string() + ":" + std::to_string(at + 1);
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t begin = line.find_first_not_of(" \t"); begin != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(" \t", end);
    }
    return words;
}

double number_in(std::string_view word, const std::string& where) {
    double value = 0.0;
    if (word.starts_with('+')) word.remove_prefix(1);
    if (!parse_number(word, value)) {
        throw InputError(
            where, "found '" + std::string(word.substr(0, 40)) + "', expected a finite number");
    }
    return value;
}

double unless_missing(double value, double code) {
    return value >= code ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace diurna
