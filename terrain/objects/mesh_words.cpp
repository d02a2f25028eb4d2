#include "terrain/objects/mesh_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "terrain/objects/mesh_readers.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_of_line = 1 << 16;  // bytes of a line that is no polygon

/// from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

std::string hint_of(std::string_view word) {
    return word.find(',') != std::string_view::npos ? "the decimal separator is '.'" : "";
}

/// Whether a line is a comment, or a name: of a file or a part, in which a backslash is itself.
bool is_free_text(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with('#')) return true;
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    for (const char* known :
         {"comment", "obj_info", "solid", "endsolid", "g", "o", "usemtl", "mtllib"}) {
        if (is_keyword(word, known)) return true;
    }
    return false;
}

}  // namespace

bool is_keyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b;
    });
}

void MeshLines::drop_comment() {
    for (std::size_t i = 0; i < words_.size(); ++i) {
        const std::size_t sign = words_[i].find('#');
        if (sign == std::string_view::npos) continue;
        words_[i] = words_[i].substr(0, sign);
        words_.resize(words_[i].empty() ? i : i + 1);
    }
}

bool MeshLines::next() {
    words_.clear();
    if (rest_.empty()) return false;
    for (bool more = true; more && !rest_.empty();) {
        ++line_;
        const std::size_t end = rest_.find_first_of("\r\n");
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        const bool both = end != std::string_view::npos && rest_.starts_with('\n') &&
                          line.data()[line.size()] == '\r';
        if (both) rest_.remove_prefix(1);
        more = line.ends_with('\\') && !(words_.empty() && is_free_text(line));
        if (more) line.remove_suffix(1);
        if (line.size() > most_of_line && !line.starts_with("f ")) {
            throw InputError(where(), fmt::format("a line of {} bytes, expected at most {}",
                                                  line.size(), most_of_line));
        }
        constexpr std::string_view blank = " \t\v\f";
        for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
            const std::size_t stop = std::min(line.find_first_of(blank, at), line.size());
            words_.push_back(line.substr(at, stop - at));
            at = line.find_first_not_of(blank, stop);
        }
    }
    return true;
}

double MeshLines::coordinate(std::string_view word) const {
    double value = 0.0;
    if (!parse_number(without_plus(word), value)) {
        throw InputError(where(),
                         fmt::format("found '{}', expected a finite number", word.substr(0, 40)),
                         hint_of(word));
    }
    if (std::abs(value) > most_coordinate) {
        throw InputError(where(), fmt::format("found {:g}, expected a coordinate of at most {:g}",
                                              value, most_coordinate));
    }
    return value;
}

long long MeshLines::whole(std::string_view word) const {
    long long value = 0;
    const std::string_view digits = without_plus(word);
    const auto [stop, problem] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem != std::errc() || stop != digits.data() + digits.size()) {
        throw InputError(where(),
                         fmt::format("found '{}', expected a whole number", word.substr(0, 40)));
    }
    return value;
}

}  // namespace diurna
