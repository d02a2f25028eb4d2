#include "scenes/job/input/read_hours.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <optional>

namespace diurna {

namespace {

constexpr double day_seconds = 86400.0;

/// "05:30-06:10 0.3", with a date before it if it is of one day: hours and the share of the heat.
std::optional<ClockHours::Window> hours_window(const std::string& text) {
    int year = 0, month = 0, date = 0, used = 0;
    std::string rest = text;
    ClockHours::Window window{};
    if (std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &date, &used) == 3 &&
        used == 10) {
        const std::chrono::year_month_day on{std::chrono::year{year},
                                             std::chrono::month{unsigned(month)},
                                             std::chrono::day{unsigned(date)}};
        if (!on.ok()) return std::nullopt;
        window.day = std::chrono::sys_days{on}.time_since_epoch().count();
        rest = text.substr(10);
    }
    int h1 = 0, m1 = 0, h2 = 0, m2 = 0, hours_end = 0, share_end = 0;
    if (std::sscanf(rest.c_str(), " %2d:%2d-%2d:%2d%n", &h1, &m1, &h2, &m2, &hours_end) != 4) {
        return std::nullopt;
    }
    if (std::sscanf(rest.c_str() + hours_end, " %lf%n", &window.share, &share_end) != 1) {
        window.share = 1.0;
        share_end = 0;
    }
    if (std::size_t(hours_end + share_end) != rest.size()) return std::nullopt;
    window.from = 3600.0 * h1 + 60.0 * m1;
    window.to = 3600.0 * h2 + 60.0 * m2;
    const bool good = m1 < 60 && m2 < 60 && window.from < day_seconds && window.to <= day_seconds &&
                      window.from != window.to && window.share >= 0.0 && window.share <= 1.0;
    if (window.to < window.from) window.to += day_seconds;  // over midnight
    return good ? std::optional(window) : std::nullopt;
}

/// Whether two windows have a moment in common, on some day.
bool overlap(const ClockHours::Window& a, const ClockHours::Window& b) {
    const long apart = a.day && b.day ? *b.day - *a.day : 0;
    for (const long days : {apart - 1, apart, apart + 1}) {
        if (a.day && b.day && days != apart) continue;
        const double later = double(days) * day_seconds;
        if (a.from < b.to + later && b.from + later < a.to) return true;
    }
    return false;
}

}  // namespace

std::vector<ClockHours::Window> windows_of(const Section& section, const char* key,
                                           const std::vector<std::string>& texts) {
    std::vector<ClockHours::Window> hours;
    for (const std::string& text : texts) {
        if (const auto window = hours_window(text)) {
            hours.push_back(*window);
        } else {
            section.mistake(
                key,
                fmt::format("found '{}', expected hours and a share such as 05:30-06:10 0.3",
                            text.substr(0, 60)),
                "hours of the day up to 24:00, share 0 to 1 (default: 1)");
        }
    }
    for (std::size_t i = 0; i < hours.size() && hours.size() == texts.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (!overlap(hours[k], hours[i])) continue;
            section.mistake(key, fmt::format("'{}' overlaps '{}', expected one share at a time",
                                             texts[i].substr(0, 60), texts[k].substr(0, 60)));
        }
    }
    return hours;
}

std::vector<ClockHours::Window> read_hours(const Section& section) {
    const std::vector<std::string> texts = section.texts_or(
        "hours",
        "times of heat release and its share: \"05:30-06:10 1.0\", \"06:10-07:00 0.3\" on every "
        "day, by the clock of time.start, or on one day: \"2026-07-15 05:30-06:10\"; a temperature "
        "is held during these times, otherwise it follows the air",
        {std::vector<std::string>{}, "always"});
    if (section.has("hours") && texts.empty()) {
        section.mistake("hours",
                        "found no hours, expected at least one; without the key it is always on");
    }
    return windows_of(section, "hours", texts);
}

bool read_runs(const Section& section) {
    const bool runs = section.flag_or(
        "runs", "heat is released only in the hours of the object's `running`", false);
    if (runs && section.has("hours")) {
        section.mistake("hours", "cannot be combined with runs = true");
    }
    return runs;
}

}  // namespace diurna
