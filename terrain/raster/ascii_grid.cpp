#include "terrain/raster/ascii_grid.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>

#include "materials/base/error.hpp"
#include "terrain/raster/zip_archive.hpp"

namespace diurna {

namespace {

bool is_finite_number(const std::string& word) {
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const char* const start = word.data() + (word.front() == '+' ? 1 : 0);
    const auto [stop, problem] = std::from_chars(start, end, value);
    return problem == std::errc() && stop == end && std::isfinite(value);
}

}  // namespace

void check_ascii_grid(const std::filesystem::path& file, std::size_t posts) {
    std::istringstream text(unpacked_text(file));
    std::string word, value;
    // The header is pairs of a keyword and a value; heights begin where no keyword stands.
    bool in_header = true;
    std::size_t heights = 0;
    while (text >> word) {
        if (in_header && std::isalpha(static_cast<unsigned char>(word.front())) && text >> value) {
            continue;
        }
        in_header = false;
        ++heights;
        if (!is_finite_number(word)) {
            throw InputError(file.string(),
                             fmt::format("found '{}' as value {}, expected a number",
                                         word.substr(0, 40), heights),
                             word.find(',') != word.npos ? "the decimal separator is '.'" : "");
        }
    }
    if (heights != posts) {
        throw InputError(file.string(), fmt::format("has {} values, expected {}", heights, posts));
    }
}

}  // namespace diurna
