#include "thermal/weather_file/unused_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// "windSpeed_m_s" as wind, speed, m, s.
std::vector<std::string> words_in(std::string_view name) {
    std::vector<std::string> words;
    bool within = false, small = false;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) == 0) {
            within = false;
            continue;
        }
        const bool capital = std::isupper(letter) != 0;
        if (!within || (capital && small)) words.emplace_back();
        words.back() += static_cast<char>(std::tolower(letter));
        within = true;
        small = !capital;
    }
    return words;
}

using Words = std::initializer_list<const char*>;

/// Words by which a column is known: any of `whole` as a word, or any of `part` within one.
struct NameOf {
    Quantity quantity;
    Words whole, part;
};

bool has_word(const std::vector<std::string>& words, Words wanted) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
    });
}

bool has_part(const std::vector<std::string>& words, Words wanted) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return std::any_of(wanted.begin(), wanted.end(),
                           [&](const char* part) { return word.find(part) != std::string::npos; });
    });
}

/// Names of what is measured beside a quantity: its direction, quality, extremes, models of it.
bool is_beside(const std::vector<std::string>& words) {
    return has_word(words, {"dir", "wdir", "max", "min", "std", "sd", "qc", "id", "type", "code",
                            "base", "net", "height"}) ||
           has_part(words,
                    {"direction", "gust", "flag", "quality", "source", "precipitable", "uncert",
                     "clear", "angle", "zenith", "azimuth", "soil", "albedo", "duration"});
}

std::optional<Quantity> by_words(const std::vector<std::string>& words) {
    const bool up = has_word(words, {"up", "out", "upward", "upwelling", "outgoing", "reflected"});
    const NameOf upward[] = {
        {Quantity::shortwave_up, {"swout", "swup", "rsus"}, {"reflected", "shortwave", "solar"}}};
    const NameOf names[] = {
        {Quantity::dew_point, {"dwpt", "dwpf", "dwpc", "td", "tdew", "d2m"}, {"dew"}},
        {Quantity::relative_humidity, {"rh", "relh", "rhum", "hurs"}, {"humid"}},
        {Quantity::wind_speed,
         {"wspd", "wdsp", "ws", "sknt", "wnd", "ff", "spd", "si10", "fg10", "ws10", "u10", "v10",
          "u100", "v100", "si100", "ws100"},
         {"wind"}},
        {Quantity::pressure, {"pres", "sp", "baro", "bp", "stp"}, {"press", "barom"}},
        {Quantity::altimeter, {"alti", "qnh"}, {"altimeter"}},
        {Quantity::rain, {"prcp", "tp", "p01i", "p01m", "pr"}, {"rain", "precip"}},
        {Quantity::cloud_fraction, {"tcc", "okta", "oktas"}, {"cloud"}},
        {Quantity::longwave_down,
         {"lwdown", "rlds", "strd", "strdc", "ir", "dlr", "lw", "lwin", "ldown", "lwd"},
         {"longwave", "infrared", "thermal"}},
        {Quantity::diffuse, {"dhi", "dif", "dhr"}, {"diffuse"}},
        {Quantity::direct_normal, {"dni", "bni", "dnr"}, {"direct", "beam"}},
        {Quantity::shortwave_down,
         {"ghi", "swdown", "rsds", "ssrd", "swin", "kdown", "sw", "swd", "ssr", "rg"},
         {"global", "shortwave", "solar", "irradiance", "insolation"}},
    };
    const auto known = [&](const NameOf& one) {
        return has_word(words, one.whole) || has_part(words, one.part);
    };
    if (up) return known(upward[0]) ? std::optional(upward[0].quantity) : std::nullopt;
    for (const NameOf& one : names) {
        if (known(one)) return one.quantity;
    }
    return std::nullopt;
}

/// Whether another column says the same: humidity by the dew point, pressure by the altimeter.
bool is_given(const WeatherTable& table, Quantity quantity) {
    const auto any = [&](std::initializer_list<Quantity> list) {
        return std::any_of(list.begin(), list.end(), [&](Quantity q) { return table.has(q); });
    };
    switch (quantity) {
        case Quantity::dew_point:
        case Quantity::relative_humidity:
            return any({Quantity::dew_point, Quantity::relative_humidity});
        case Quantity::pressure:
        case Quantity::altimeter:
            return any({Quantity::pressure, Quantity::altimeter});
        default:
            return table.has(quantity);
    }
}

}  // namespace

std::optional<Quantity> looks_like(std::string_view column) {
    const std::vector<std::string> words = words_in(column);
    if (is_beside(words)) return std::nullopt;
    if (const auto found = by_words(words)) return found;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < quantity_count; ++i) {
        known.emplace_back(facts(quantity_at(i)).column);
        known.emplace_back(facts(quantity_at(i)).name);
    }
    const std::string near = nearest(column, known);
    if (near.empty() || column.size() < 6) return std::nullopt;
    const auto by_column = quantity_of_column(near);
    return by_column ? by_column : quantity_named(near);
}

void warn_of_unused_columns(WeatherTable& table) {
    std::array<bool, quantity_count> warned{};
    for (const std::string& column : table.unused) {
        const auto quantity = looks_like(column);
        if (!quantity || is_given(table, *quantity) || warned[index(*quantity)]) continue;
        warned[index(*quantity)] = true;
        const QuantityFacts& f = facts(*quantity);
        table.warnings.push_back(
            {table.file.string() + ": " + column,
             fmt::format("this column is not used, and there is no other {}{}", f.name,
                         f.modelled != nullptr ? fmt::format(": {} is assumed", f.modelled) : ""),
             table.declarable
                 ? fmt::format(
                       "describe it in [weather.columns]: {} = \"{} UNIT\", the unit one of {}",
                       column, f.name, fmt::join(unit_names(*quantity), ", "))
                 : ""});
    }
}

}  // namespace diurna
