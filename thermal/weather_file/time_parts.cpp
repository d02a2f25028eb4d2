#include "thermal/weather_file/time_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "materials/base/error.hpp"
#include "thermal/weather_file/text_lines.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

namespace {

constexpr std::array<const char*, 14> part_names{
    "time", "time_dmy", "time_mdy", "date",        "date_dmy", "date_mdy", "clock",
    "year", "month",    "day",      "day_of_year", "hour",     "minute",   "second"};

/// The calendar of a row as its parts have been read.
struct CalendarRow {
    int year = 0, month = 1, day = 1;
    double seconds = 0.0;
};

bool all_taken(int read, int expected, int taken, const std::string& text) {
    return read == expected && taken == int(text.size());
}

void read_date(const std::string& text, const std::string& where, CalendarRow& row) {
    for (const char* format : {"%4d-%2d-%2d%n", "%4d/%2d/%2d%n", "%4d%2d%2d%n"}) {
        int taken = 0;
        const int read = std::sscanf(text.c_str(), format, &row.year, &row.month, &row.day, &taken);
        if (all_taken(read, 3, taken, text) && row.year > 1000) return;
    }
    throw InputError(where, fmt::format("found '{}', expected a date such as 2021-07-08 or "
                                        "20210708",
                                        text.substr(0, 40)));
}

/// "08.07.2021", "8/7/2021" or "8-7-2021": the day first, or the month.
void read_ordered_date(const std::string& text, bool month_first, const std::string& where,
                       CalendarRow& row) {
    int first = 0, second = 0, taken = 0;
    const int read = std::sscanf(text.c_str(), "%2d%*1[-/.]%2d%*1[-/.]%4d%n", &first, &second,
                                 &row.year, &taken);
    if (!all_taken(read, 3, taken, text) || row.year <= 1000) {
        throw InputError(where,
                         fmt::format("found '{}', expected a date such as {}", text.substr(0, 40),
                                     month_first ? "7/28/2021 (month, day, year)"
                                                 : "28.07.2021 (day, month, year)"));
    }
    row.month = month_first ? first : second;
    row.day = month_first ? second : first;
}

/// Takes " AM" or " PM" off a time of day: the hours that it adds to 1 to 11 o'clock, 0 without.
std::optional<int> hours_of_half_day(std::string& text) {
    for (const char* half : {"AM", "PM", "am", "pm"}) {
        if (!text.ends_with(half)) continue;
        text.resize(text.size() - 2);
        while (text.ends_with(' ')) text.pop_back();
        return half[0] == 'P' || half[0] == 'p' ? 12 : 0;
    }
    return std::nullopt;
}

void read_clock(std::string text, const std::string& where, CalendarRow& row) {
    const std::optional<int> half = hours_of_half_day(text);
    int hour = 0, minute = 0, second = 0, taken = 0;
    // Each read by itself: what was taken is known only behind it.
    int read = std::sscanf(text.c_str(), "%2d:%2d:%2d%n", &hour, &minute, &second, &taken);
    bool whole = all_taken(read, 3, taken, text);
    if (!whole) {
        second = taken = 0;
        read = std::sscanf(text.c_str(), "%2d:%2d%n", &hour, &minute, &taken);
        whole = all_taken(read, 2, taken, text);
    }
    if (whole && half) {
        if (hour < 1 || hour > 12) {
            throw InputError(where,
                             fmt::format("found hour {} with AM or PM, expected 1 to 12", hour));
        }
        hour = hour % 12 + *half;
    }
    if (whole) {
        row.seconds += 3600.0 * hour + 60.0 * minute + second;
        return;
    }
    const bool digits = !half && !text.empty() && text.size() <= 4 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    if (!digits) {
        throw InputError(where, fmt::format("found '{}', expected a time of day such as 13:30 or "
                                            "1330",
                                            text.substr(0, 40)));
    }
    const int number = std::stoi(text);
    row.seconds += 3600.0 * (number / 100) + 60.0 * (number % 100);
}

/// A date and, behind a blank or a T, a time of day.
void read_ordered_time(const std::string& text, bool month_first, const std::string& where,
                       CalendarRow& row) {
    const std::size_t gap = text.find_first_of(" T");
    read_ordered_date(text.substr(0, gap), month_first, where, row);
    if (gap != std::string::npos) read_clock(text.substr(gap + 1), where, row);
}

int whole_number(const std::string& text, const std::string& where, TimePart part) {
    const double value = number_in(text, where);
    if (value != std::round(value) || std::abs(value) > 9999.0) {
        throw InputError(where, fmt::format("found '{}', expected a whole {}", text.substr(0, 40),
                                            part_names[std::size_t(part)]));
    }
    return static_cast<int>(value);
}

void to_day_of_year(int day_of_year, const std::string& where, CalendarRow& row) {
    using namespace std::chrono;
    const int most = std::chrono::year(row.year).is_leap() ? 366 : 365;
    if (day_of_year < 1 || day_of_year > most) {
        throw InputError(where, fmt::format("found day {} of {}, expected 1 to {}", day_of_year,
                                            row.year, most));
    }
    const year_month_day date(sys_days(std::chrono::year(row.year) / January / 1) +
                              days(day_of_year - 1));
    row.month = int(unsigned(date.month()));
    row.day = int(unsigned(date.day()));
}

}  // namespace

std::optional<TimePart> time_part_named(std::string_view word) {
    const auto found = std::find(part_names.begin(), part_names.end(), word);
    if (found == part_names.end()) return std::nullopt;
    return static_cast<TimePart>(found - part_names.begin());
}

std::vector<std::string> time_part_names() { return {part_names.begin(), part_names.end()}; }

Instant instant_of_parts(std::span<const TimeCell> cells, double offset_h,
                         const std::string& where) {
    CalendarRow row;
    int day_of_year = 0;
    for (const auto& [part, text] : cells) {
        switch (part) {
            case TimePart::whole:
                break;
            case TimePart::whole_dmy:
            case TimePart::whole_mdy:
                read_ordered_time(text, part == TimePart::whole_mdy, where, row);
                break;
            case TimePart::date_dmy:
            case TimePart::date_mdy:
                read_ordered_date(text, part == TimePart::date_mdy, where, row);
                break;
            case TimePart::date:
                read_date(text, where, row);
                break;
            case TimePart::clock:
                read_clock(text, where, row);
                break;
            case TimePart::year:
                row.year = whole_number(text, where, part);
                break;
            case TimePart::month:
                row.month = whole_number(text, where, part);
                break;
            case TimePart::day:
                row.day = whole_number(text, where, part);
                break;
            case TimePart::day_of_year:
                day_of_year = whole_number(text, where, part);
                break;
            case TimePart::hour:
                row.seconds += 3600.0 * number_in(text, where);
                break;
            case TimePart::minute:
                row.seconds += 60.0 * number_in(text, where);
                break;
            case TimePart::second:
                row.seconds += number_in(text, where);
                break;
        }
    }
    if (day_of_year != 0) to_day_of_year(day_of_year, where, row);
    return local_instant(row.year, row.month, row.day, row.seconds, offset_h, where);
}

void check_time_parts(std::span<const TimePart> parts, const std::string& where) {
    const auto has = [&](TimePart part) {
        return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    const bool by_month = has(TimePart::month) && has(TimePart::day);
    const bool by_date = has(TimePart::date) || has(TimePart::date_dmy) ||
                         has(TimePart::date_mdy) || has(TimePart::whole_dmy) ||
                         has(TimePart::whole_mdy);
    if (by_date || (has(TimePart::year) && (by_month || has(TimePart::day_of_year)))) {
        return;
    }
    throw InputError(where,
                     "[weather.columns] has no column for the day, expected date, or year with "
                     "month and day, or year with day_of_year");
}

}  // namespace diurna
