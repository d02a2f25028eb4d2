#include "thermal/weather_file/recognised_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "materials/base/error.hpp"
#include "thermal/weather_file/stamps.hpp"
#include "thermal/weather_file/unused_columns.hpp"
#include "thermal/weather_file/weather_format.hpp"

namespace diurna {

namespace {

/// Spellings of units in headers, in small letters without blanks and marks of powers.
constexpr std::array<std::pair<std::string_view, std::string_view>, 50> spellings{{
    {"k", "K"},           {"kelvin", "K"},
    {"degc", "degC"},     {"c", "degC"},
    {"°c", "degC"},       {"celsius", "degC"},
    {"degf", "degF"},     {"f", "degF"},
    {"°f", "degF"},       {"fahrenheit", "degF"},
    {"%", "%"},           {"percent", "%"},
    {"pct", "%"},         {"1", "1"},
    {"fraction", "1"},    {"0-1", "1"},
    {"pa", "Pa"},         {"hpa", "hPa"},
    {"mbar", "mbar"},     {"mb", "mb"},
    {"kpa", "kPa"},       {"inhg", "inHg"},
    {"m/s", "m/s"},       {"ms-1", "m/s"},
    {"mps", "m/s"},       {"kn", "kn"},
    {"kt", "kt"},         {"kts", "kn"},
    {"knots", "kn"},      {"km/h", "km/h"},
    {"kmh", "km/h"},      {"kmh-1", "km/h"},
    {"kph", "km/h"},      {"mph", "mph"},
    {"mm/h", "mm/h"},     {"mmh-1", "mm/h"},
    {"mm/hr", "mm/h"},    {"mm", "mm"},
    {"in", "in"},         {"inch", "in"},
    {"okta", "okta"},     {"oktas", "okta"},
    {"tenths", "tenths"}, {"w/m2", "W/m2"},
    {"wm-2", "W/m2"},     {"wm2", "W/m2"},
    {"w/sqm", "W/m2"},    {"kj/m2", "kJ/m2"},
    {"mj/m2", "MJ/m2"},   {"wh/m2", "Wh/m2"},
}};

/// Small letters, without blanks, '^', '*' and '.', '²' as 2, '⁻' as -.
std::string bare(std::string text) {
    const auto put = [&](std::string_view from, std::string_view to) {
        for (auto at = text.find(from); at != std::string::npos; at = text.find(from)) {
            text.replace(at, from.size(), to);
        }
    };
    put("²", "2");
    put("⁻¹", "-1");
    put("⁻", "-");
    std::erase_if(text, [](char c) { return c == ' ' || c == '^' || c == '*' || c == '.'; });
    return small_letters(text);
}

/// The unit that a part of a name says for a quantity, as [weather.columns] has it; "" for none.
std::string unit_in(Quantity quantity, const std::string& part) {
    const std::string word = bare(part);
    const auto found = std::find_if(spellings.begin(), spellings.end(),
                                    [&](const auto& one) { return one.first == word; });
    if (word.empty() || found == spellings.end()) return "";
    return unit_named(quantity, found->second) ? std::string(found->second) : "";
}

/// A name and the part of it that may be a unit.
struct NameParts {
    std::string name, unit;
};

/// Possible divisions of a header's name: at brackets, or at each separator from the right.
std::vector<NameParts> divisions(const std::string& header) {
    std::vector<NameParts> found;
    for (const auto& [open, close] : {std::pair{'(', ')'}, {'[', ']'}, {'{', '}'}}) {
        const std::size_t begin = header.find(open), end = header.rfind(close);
        if (begin == header.npos || end == header.npos || end < begin) continue;
        found.push_back({header.substr(0, begin), header.substr(begin + 1, end - begin - 1)});
    }
    for (std::size_t at = header.size(); at-- > 1;) {
        if (std::string_view("_ ,:/").find(header[at]) == std::string_view::npos) continue;
        std::string unit = header.substr(at + 1);
        found.push_back({header.substr(0, at), unit});
        std::replace(unit.begin(), unit.end(), '_', '/');  // m_s, W_m2
        found.push_back({header.substr(0, at), unit});
    }
    return found;
}

std::vector<std::string> words_of_name(const std::string& name) {
    std::vector<std::string> words{""};
    for (const char c : small_letters(name)) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    return words;
}

bool any_of_words(const std::vector<std::string>& words,
                  std::initializer_list<std::string_view> wanted) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
    });
}

/// Whether a name is that of the air's temperature, and no other's.
bool names_air_temperature(const std::string& name) {
    const std::vector<std::string> words = words_of_name(name);
    if (any_of_words(words, {"soil", "ground", "surface", "skin", "road", "dew", "wet", "water",
                             "sky", "panel", "module", "body", "min", "max", "sensor", "ir"})) {
        return false;
    }
    return any_of_words(words, {"t", "ta", "tair", "airt", "t2m", "tmp", "tmpc", "tmpf", "tdb",
                                "temp", "temperature", "airtemp", "drybulb", "lufttemperatur"}) ||
           small_letters(name).find("temperature") != std::string::npos;
}

std::optional<Quantity> quantity_in(const std::string& name) {
    if (const auto own = quantity_named(name)) return own;
    if (names_air_temperature(name)) return Quantity::air_temperature;
    return looks_like(name);
}

std::optional<RecognisedColumn> recognised_quantity(const std::string& header) {
    if (const auto own = quantity_of_column(header)) {
        std::string unit = unit_names(*own).front();
        if (*own == Quantity::rain) unit = "mm/h";
        return RecognisedColumn{header, own, fmt::format("{} {}", facts(*own).name, unit), true};
    }
    for (const NameParts& parts : divisions(header)) {
        const auto quantity = quantity_in(parts.name);
        const std::string unit = quantity ? unit_in(*quantity, parts.unit) : "";
        if (unit.empty()) continue;
        return RecognisedColumn{header, quantity, fmt::format("{} {}", facts(*quantity).name, unit),
                                true};
    }
    const auto quantity = quantity_in(header);
    if (!quantity) return std::nullopt;
    return RecognisedColumn{header, quantity, fmt::format("{} UNIT", facts(*quantity).name)};
}

/// Whether a cell is an instant; `offset_h` NaN: with its own offset.
bool is_stamp(const std::string& cell, double offset_h) {
    try {
        stamp_in(cell, offset_h, "");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::optional<RecognisedColumn> recognised_time(const CsvTable& table, std::size_t column) {
    const std::string& header = table.header[column];
    const std::vector<std::string> words = words_of_name(header);
    if (!any_of_words(words, {"time", "datetime", "timestamp", "date", "valid", "utc", "gmt",
                              "stamp", "zeit"})) {
        return std::nullopt;
    }
    const bool utc = any_of_words(words, {"utc", "gmt"});
    const std::string cell = table.rows.empty() ? "" : table.rows.front()[column];
    if (is_stamp(cell, std::nan(""))) return RecognisedColumn{header, {}, "time", true};
    if (is_stamp(cell, 0.0)) {
        return RecognisedColumn{header, {}, utc ? "time UTC" : "time UTC-OFFSET", utc};
    }
    return std::nullopt;
}

}  // namespace

std::vector<RecognisedColumn> recognised_columns(const CsvTable& table) {
    std::vector<RecognisedColumn> found;
    for (std::size_t c = 0; c < table.header.size(); ++c) {
        auto column = recognised_time(table, c);
        if (!column) column = recognised_quantity(table.header[c]);
        if (!column) continue;
        const auto same = std::find_if(found.begin(), found.end(), [&](const auto& one) {
            return one.quantity == column->quantity;
        });
        if (same == found.end()) {
            found.push_back(std::move(*column));
        } else if (column->whole && !same->whole) {
            *same = std::move(*column);
        }
    }
    return found;
}

std::vector<std::string> as_declarations(const std::vector<RecognisedColumn>& columns) {
    std::vector<std::string> lines;
    for (const RecognisedColumn& one : columns) {
        const bool plain = std::all_of(one.name.begin(), one.name.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 || c == '_' || c == '-';
        });
        lines.push_back(plain ? fmt::format("{} = \"{}\"", one.name, one.says)
                              : fmt::format("'{}' = \"{}\"", one.name, one.says));
    }
    return lines;
}

}  // namespace diurna
