#include "materials/air/igra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();
constexpr double removed = -8888.0;  // and -9999: missing

/// A line of the archive's text with its number, from 1.
struct IgraLine {
    std::string_view text;
    int number;
};

std::vector<IgraLine> igra_lines(std::string_view text) {
    std::vector<IgraLine> lines;
    int number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = text.substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back({line, ++number});
        begin = end + 1;
    }
    return lines;
}

bool is_head(std::string_view line) {
    constexpr std::size_t until_hour = 26;
    return line.size() >= until_hour && line.front() == '#' && line[12] == ' ' &&
           line.find_first_not_of("0123456789", 13) == 17 && line[17] == ' ' && line[20] == ' ';
}

/// "2018-07-15T00" of a head.
std::string time_of_head(std::string_view head) {
    return fmt::format("{}-{}-{}T{}", head.substr(13, 4), head.substr(18, 2), head.substr(21, 2),
                       head.substr(24, 2));
}

/// The number in columns counted from 1; NaN where it is missing. Throws InputError.
double field(const std::filesystem::path& file, const IgraLine& line, std::size_t from,
             std::size_t to) {
    if (line.text.size() < from) return absent;
    std::string_view cell = line.text.substr(from - 1, to - from + 1);
    const std::size_t begin = cell.find_first_not_of(' ');
    if (begin == std::string_view::npos) return absent;
    cell = cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin);
    double value = 0.0;
    if (!parse_number(cell, value)) {
        throw InputError(fmt::format("{}:{}:{}", file.string(), line.number, from),
                         fmt::format("found '{}', expected a number", cell));
    }
    return value <= removed ? absent : value;
}

struct IgraLevel {
    int line;
    double pressure_hPa, height, celsius, dew_point;  // [m]; NaN: missing
};

/// What the air between two levels adds to the height [m], at their mean temperature.
double thickness(const IgraLevel& below, const IgraLevel& above) {
    const double mean = kelvin(0.5 * (below.celsius + above.celsius));
    return dry_air_gas_constant * mean / gravity *
           std::log(below.pressure_hPa / above.pressure_hPa);
}

/// Heights of levels that have none; returns how many. None is known: throws nothing, fills none.
std::size_t fill_heights(std::vector<IgraLevel>& levels) {
    const auto known = [&](std::size_t i) { return !std::isnan(levels[i].height); };
    std::size_t first = 0, filled = 0;
    while (first < levels.size() && !known(first)) ++first;
    if (first == levels.size()) return 0;
    for (std::size_t i = first; i-- > 0; ++filled) {
        levels[i].height = levels[i + 1].height - thickness(levels[i], levels[i + 1]);
    }
    for (std::size_t low = first; low < levels.size();) {
        std::size_t high = low + 1;
        while (high < levels.size() && !known(high)) ++high;
        double whole = 0.0;
        for (std::size_t i = low + 1; i <= high && i < levels.size(); ++i) {
            whole += thickness(levels[i - 1], levels[i]);
        }
        double fit = 1.0;
        if (high < levels.size() && whole > 0.0) {
            fit = (levels[high].height - levels[low].height) / whole;
            if (!(fit > 0.8 && fit < 1.2)) fit = 1.0;  // one of the two heights is wrong
        }
        for (std::size_t i = low + 1; i < high; ++i, ++filled) {
            levels[i].height = levels[i - 1].height + fit * thickness(levels[i - 1], levels[i]);
        }
        low = high;
    }
    return filled;
}

std::string cell_of(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

/// The lines of the sounding of a time, head first.
std::vector<IgraLine> sounding_lines(const std::filesystem::path& file, std::string_view text,
                                     const std::string& time) {
    const std::vector<IgraLine> lines = igra_lines(text);
    std::vector<std::size_t> heads;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (is_head(lines[i].text)) heads.push_back(i);
    }
    const std::string first = time_of_head(lines[heads.front()].text),
                      last = time_of_head(lines[heads.back()].text);
    if (time.empty() && heads.size() > 1) {
        throw InputError(file.string(),
                         fmt::format("has {} soundings, from {} to {}", heads.size(), first, last),
                         fmt::format("select one: sounding_time = \"{}\"", last));
    }
    for (std::size_t k = 0; k < heads.size(); ++k) {
        if (!time.empty() && time_of_head(lines[heads[k]].text) != time.substr(0, 13)) continue;
        const std::size_t end = k + 1 < heads.size() ? heads[k + 1] : lines.size();
        return {lines.begin() + std::ptrdiff_t(heads[k]), lines.begin() + std::ptrdiff_t(end)};
    }
    throw InputError(file.string(), fmt::format("has no sounding of {}; it has {}, from {} to {}",
                                                time, heads.size(), first, last));
}

}  // namespace

bool is_igra(std::string_view text) { return is_head(text.substr(0, text.find('\n'))); }

std::vector<std::string> igra_times(std::string_view text) {
    std::vector<std::string> times;
    for (const IgraLine& line : igra_lines(text)) {
        if (is_head(line.text)) times.push_back(time_of_head(line.text));
    }
    return times;
}

SoundingTable read_igra(const std::filesystem::path& file, std::string_view text,
                        const std::string& time) {
    const std::vector<IgraLine> lines = sounding_lines(file, text, time);
    std::vector<IgraLevel> levels;
    std::size_t without = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const IgraLine& line = lines[i];
        if (line.text.find_first_not_of(' ') == std::string_view::npos) continue;
        const double humidity = 1e-3 * field(file, line, 29, 33),
                     depression = 0.1 * field(file, line, 35, 39);
        IgraLevel level{.line = line.number,
                        .pressure_hPa = 0.01 * field(file, line, 10, 15),
                        .height = field(file, line, 17, 21),
                        .celsius = 0.1 * field(file, line, 23, 27),
                        .dew_point = absent};
        if (std::isnan(level.pressure_hPa) || std::isnan(level.celsius)) {
            ++without;
            continue;
        }
        level.dew_point = level.celsius - depression;
        if (std::isnan(depression) && humidity > 0.0) {
            // Magnus, by the constants of the humidity's own formula (Bolton 1980).
            const double x = std::log(humidity) + 17.67 * level.celsius / (level.celsius + 243.5);
            level.dew_point = 243.5 * x / (17.67 - x);
        }
        levels.push_back(level);
    }
    const std::size_t filled = fill_heights(levels);
    if (levels.empty() || std::isnan(levels.front().height)) {
        throw InputError(fmt::format("{}:{}", file.string(), lines.front().number),
                         "the sounding has no level with pressure, temperature and height");
    }
    SoundingTable sounding{{.path = file,
                            .header = {"pressure_hPa", "height_m", "temperature_C", "dew_point_C"},
                            .rows = {},
                            .line = {}},
                           true};
    for (const IgraLevel& level : levels) {
        sounding.table.rows.push_back({cell_of(level.pressure_hPa), cell_of(level.height),
                                       cell_of(level.celsius), cell_of(level.dew_point)});
        sounding.table.line.push_back(level.line);
    }
    if (filled > 0) {
        sounding.notes.push_back(
            fmt::format("{}: the heights of {} of {} levels are computed hydrostatically from the "
                        "levels with a height",
                        file.string(), filled, levels.size()));
    }
    if (without > 0) {
        sounding.notes.push_back(fmt::format("{}: {} without pressure or temperature skipped",
                                             file.string(), number_of(without, "level")));
    }
    return sounding;
}

}  // namespace diurna
