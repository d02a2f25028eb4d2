#include "thermal/weather_file/bsrn.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/text_lines.hpp"

namespace diurna {

namespace {

/// The lines of logical record `number` ("0100"), without its head; empty where it is not there.
struct Record {
    std::size_t begin = 0, end = 0;
};
Record record(const TextLines& lines, std::string_view number) {
    for (std::size_t i = 0; i < lines.line.size(); ++i) {
        const std::string_view head = lines.line[i];
        if (!head.starts_with('*') || head.size() < 6 || head.substr(2, 4) != number) continue;
        std::size_t end = i + 1;
        while (end < lines.line.size() && !lines.line[end].starts_with('*')) ++end;
        return {i + 1, end};
    }
    return {};
}

int whole(std::string_view word, const std::string& where) {
    return int(std::lround(number_in(word, where)));
}

/// A value, or NaN for a code of missing: -999 of whole numbers, -99.9 of those with a decimal.
double value_in(std::string_view word, const std::string& where) {
    const double value = number_in(word, where);
    return value <= -999.0 || word == "-99.9" || word == "-99.90" ? not_measured : value;
}

std::vector<std::string_view> words_at(const TextLines& lines, std::size_t i, std::size_t count) {
    const std::vector<std::string_view> words =
        i < lines.line.size() ? words_of(lines.line[i]) : std::vector<std::string_view>{};
    if (words.size() < count) {
        throw InputError(lines.where(i),
                         fmt::format("found {} words, expected {}", words.size(), count));
    }
    return words;
}

struct Month {
    int year, month;
};

/// Two lines: day, minute, global, direct; diffuse, longwave, air. Of each mean, deviation, least,
/// most.
void read_minute(const TextLines& lines, std::size_t i, const Month& month,
                 const std::map<std::pair<int, int>, double>& reflected, WeatherTable& table) {
    const auto first = words_at(lines, i, 10), second = words_at(lines, i + 1, 11);
    const std::string where = lines.where(i), below = lines.where(i + 1);
    const int day = whole(first[0], where), minute = whole(first[1], where);
    add_row(table, local_instant(month.year, month.month, day, 60.0 * minute, 0.0, where), where);
    put(table, Quantity::shortwave_down, value_in(first[2], where), where);
    put(table, Quantity::direct_normal, value_in(first[6], where), where);
    put(table, Quantity::diffuse, value_in(second[0], below), below);
    put(table, Quantity::longwave_down, value_in(second[4], below), below);
    put(table, Quantity::air_temperature, kelvin(value_in(second[8], below)), below);
    put(table, Quantity::relative_humidity, 0.01 * value_in(second[9], below), below);
    put(table, Quantity::pressure, 100.0 * value_in(second[10], below), below);
    if (const auto up = reflected.find({day, minute}); up != reflected.end()) {
        put(table, Quantity::shortwave_up, up->second, where);
    }
}

}  // namespace

WeatherTable read_bsrn(const std::filesystem::path& file) {
    const TextLines lines(file);
    const Record head = record(lines, "0001"), site = record(lines, "0004"),
                 basic = record(lines, "0100"), other = record(lines, "0300");
    if (basic.begin == basic.end || head.begin == head.end) {
        throw InputError(file.string(), "has no logical record 0100 (basic measurements)");
    }
    const auto station = words_at(lines, head.begin, 3);
    const Month month{whole(station[2], lines.where(head.begin)),
                      whole(station[1], lines.where(head.begin))};
    WeatherTable table{.file = file, .format = "BSRN"};
    table.stamps = Stamp::start;
    if (site.end > site.begin + 5) {
        const std::string where = lines.where(site.begin + 5);
        const auto place = words_at(lines, site.begin + 5, 3);
        table.place = {number_in(place[0], where) - 90.0, number_in(place[1], where) - 180.0,
                       number_in(place[2], where)};
    }
    std::map<std::pair<int, int>, double> reflected;
    for (std::size_t i = other.begin; i < other.end; ++i) {
        const auto words = words_at(lines, i, 3);
        const std::string where = lines.where(i);
        reflected[{whole(words[0], where), whole(words[1], where)}] = value_in(words[2], where);
    }
    for (std::size_t i = basic.begin; i < basic.end; i += 2) {
        read_minute(lines, i, month, reflected, table);
    }
    return table;
}

}  // namespace diurna
