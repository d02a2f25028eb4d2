#include "terrain/raster/height_unit.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double standard_gravity = 9.80665;  // [m s⁻²]
constexpr HeightUnit metre{1.0, "metre"}, foot{0.3048, "foot"},
    survey_foot{1200.0 / 3937.0, "US survey foot"},
    geopotential{1.0 / standard_gravity, "m2 s-2 (geopotential)"};

/// Small letters and digits alone, words apart by one blank; signs of powers and divisions stay.
std::string spelled_plainly(std::string_view text) {
    std::string word = small_letters(text);
    for (const auto& [sign, plain] :
         {std::pair<std::string, std::string>{"²", "2"}, {"⁻", "-"}, {"¹", "1"}, {"·", " "}}) {
        for (std::size_t at; (at = word.find(sign)) != std::string::npos;) {
            word.replace(at, sign.size(), plain);
        }
    }
    std::string plain;
    for (const char c : word) {
        const bool parts = c == ' ' || c == '_' || c == '.' || c == '\t' || c == ',';
        if (parts && !plain.empty() && plain.back() != ' ') plain += ' ';
        if (parts || c == '[' || c == ']' || c == '(' || c == ')' || c == '*' || c == '^') continue;
        plain += c;
    }
    if (plain.ends_with(' ')) plain.pop_back();
    return plain;
}

std::string without(std::string text, std::string_view letters) {
    std::erase_if(text, [&](char c) { return letters.find(c) != std::string_view::npos; });
    return text;
}

/// "m above sea level" is metres: what the height counts from is another matter.
std::string without_datum(std::string word) {
    for (const char* datum : {" above", " asl", " amsl", " a s l", " msl", " a m s l", " navd88",
                              " egm96", " egm2008", " ngvd29"}) {
        const std::size_t at = word.find(datum);
        if (at != std::string::npos && at > 0) word.erase(at);
    }
    return word;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// Feet by their words, "foot", "us survey feet", "ft us", whatever their order.
std::optional<HeightUnit> feet_of(const std::string& word) {
    if (is_one_of(word, {"'", "ftus", "usft", "ussft", "sft"})) {
        return word == "'" ? foot : survey_foot;
    }
    std::string rest = word;
    std::replace(rest.begin(), rest.end(), '-', ' ');
    rest += ' ';
    bool feet = false, american = false;
    for (std::size_t end; (end = rest.find(' ')) != std::string::npos; rest.erase(0, end + 1)) {
        const std::string one = rest.substr(0, end);
        if (is_one_of(one, {"ft", "foot", "feet", "foots", "ifoot", "ifeet"})) {
            feet = true;
        } else if (is_one_of(one, {"us", "u", "s", "usa", "survey", "american"})) {
            american = true;
        } else if (!is_one_of(one, {"", "intl", "int", "international"})) {
            return std::nullopt;
        }
    }
    if (!feet) return std::nullopt;
    return american ? survey_foot : foot;
}

}  // namespace

std::optional<HeightUnit> height_unit(std::string_view spelling) {
    const std::string word = without_datum(spelled_plainly(spelling));
    const std::string power = without(word, " ");
    if (is_one_of(power, {"m2s-2", "m2/s2", "m+2s-2", "j/kg", "jkg-1", "m2/s-2"})) {
        return geopotential;
    }
    if (const auto feet = feet_of(word)) return feet;
    std::string one = without(word, " -");
    if (one.size() > 2 && one.ends_with('s')) one.pop_back();
    if (is_one_of(one, {"m", "metre", "meter", "mtr", "metro", "mètre"})) return metre;
    if (is_one_of(one, {"gpm", "geopotentialmetre", "geopotentialmeter"})) {
        return HeightUnit{1.0, "geopotential metre"};
    }
    if (is_one_of(one, {"gpdm", "gpdam", "dam", "decametre", "decameter", "dekameter"})) {
        return HeightUnit{10.0, "decametre"};
    }
    for (const auto& [unit, prefix] : {std::pair<HeightUnit, const char*>{{1000.0, "km"}, "kilo"},
                                       {{0.1, "dm"}, "deci"},
                                       {{0.01, "cm"}, "centi"},
                                       {{0.001, "mm"}, "milli"}}) {
        const std::string stem = prefix;
        if (one == unit.name || one == stem + "metre" || one == stem + "meter") return unit;
    }
    return std::nullopt;
}

}  // namespace diurna
