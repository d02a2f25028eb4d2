#include "thermal/weather_file/surfrad.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/text_lines.hpp"

namespace diurna {

namespace {

struct SurfradColumn {
    std::size_t column;  // its flag stands behind it
    Quantity quantity;
    double factor = 1.0, offset = 0.0;
};
constexpr std::array<SurfradColumn, 9> surfrad_columns{{
    {8, Quantity::shortwave_down},
    {10, Quantity::shortwave_up},
    {12, Quantity::direct_normal},
    {14, Quantity::diffuse},
    {16, Quantity::longwave_down},
    {38, Quantity::air_temperature, 1.0, zero_celsius},
    {40, Quantity::relative_humidity, 0.01},
    {42, Quantity::wind_speed},
    {46, Quantity::pressure, 100.0},
}};
constexpr std::size_t column_count = 48;

/// Throws InputError unless two stations are one.
void check_same_place(const std::vector<std::string_view>& one,
                      const std::vector<std::string_view>& other, const std::string& where) {
    for (std::size_t k = 0; k < 2; ++k) {
        if (std::abs(number_in(one.at(k), where) - number_in(other.at(k), where)) < 0.01) continue;
        throw InputError(where, "is another station than the first row's");
    }
}

struct Flagged {
    long long bad = 0, questionable = 0;
};

void put_surfrad(const std::vector<std::string_view>& words, const std::string& where,
                 WeatherTable& table, Flagged& flagged) {
    for (const SurfradColumn& c : surfrad_columns) {
        const std::string place = fmt::format("{}:{}", where, c.column + 1);
        double value = number_in(words[c.column], place);
        const double flag = number_in(words[c.column + 1], place);
        if (value <= -9999.0) {
            value = not_measured;
        } else if (flag == 1.0) {
            value = not_measured;
            ++flagged.bad;
        } else if (flag > 1.0) {
            ++flagged.questionable;
        }
        put(table, c.quantity, c.factor * value + c.offset, place);
    }
}

}  // namespace

bool is_surfrad_place(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    return words.size() >= 4 && words[3] == "m" && line.find("version") != std::string_view::npos;
}

WeatherTable read_surfrad(const std::filesystem::path& file) {
    const TextLines lines(file);
    WeatherTable table{.file = file, .format = "SURFRAD"};
    table.stamps = Stamp::end;
    table.wind_height = table.air_height = 10.0;
    const std::vector<std::string_view> place = words_of(lines.line.at(1));
    table.place = {number_in(place.at(0), lines.where(1)),
                   -std::abs(number_in(place.at(1), lines.where(1))),
                   number_in(place.at(2), lines.where(1))};
    Flagged flagged;
    for (std::size_t i = 2; i < lines.line.size(); ++i) {
        const std::vector<std::string_view> words = words_of(lines.line[i]);
        if (words.empty()) continue;
        const std::string where = lines.where(i);
        if (i + 1 < lines.line.size() && is_surfrad_place(lines.line[i + 1])) {
            check_same_place(words_of(lines.line[i + 1]), place, lines.where(i + 1));
            ++i;  // the head of another day
            continue;
        }
        if (words.size() != column_count) {
            throw InputError(
                where, fmt::format("found {} words, expected {}", words.size(), column_count));
        }
        std::array<int, 6> time{};  // year, day of the year, month, day, hour, minute
        for (std::size_t k = 0; k < 6; ++k) time[k] = int(std::lround(number_in(words[k], where)));
        add_row(
            table,
            local_instant(time[0], time[2], time[3], 3600.0 * time[4] + 60.0 * time[5], 0.0, where),
            where);
        put_surfrad(words, where, table, flagged);
    }
    if (table.stamp.empty()) throw InputError(file.string(), "has no weather, only a header");
    if (flagged.bad > 0) {
        table.notes.push_back(fmt::format("{} flagged bad by SURFRAD treated as missing",
                                          number_of(flagged.bad, "value")));
    }
    if (flagged.questionable > 0) {
        table.notes.push_back(fmt::format("{} flagged questionable by SURFRAD used",
                                          number_of(flagged.questionable, "value")));
    }
    return table;
}

}  // namespace diurna
