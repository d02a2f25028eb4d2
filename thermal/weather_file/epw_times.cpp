#include "thermal/weather_file/epw_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/csv.hpp"

namespace diurna {

namespace {

constexpr double hour_seconds = 3600.0;

/// Rows of one hour that follow each other, up to but without `end`.
struct HourRows {
    std::size_t begin, end;
    std::size_t count() const { return end - begin; }
};

std::vector<HourRows> hours_of(const std::vector<EpwTime>& rows) {
    const auto same = [&](std::size_t a, std::size_t b) {
        return rows[a].year == rows[b].year && rows[a].month == rows[b].month &&
               rows[a].day == rows[b].day && rows[a].hour == rows[b].hour;
    };
    std::vector<HourRows> hours;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (hours.empty() || !same(hours.back().begin, i)) hours.push_back({i, i});
        hours.back().end = i + 1;
    }
    return hours;
}

std::size_t most_rows(const std::vector<HourRows>& hours) {
    std::size_t most = 1;
    for (const HourRows& hour : hours) most = std::max(most, hour.count());
    return most;
}

bool is_midnight(const EpwTime& time) {
    return (time.hour == 0 || time.hour == 24) && time.minute == 0;
}

}  // namespace

EpwHours epw_hours(const std::vector<EpwTime>& rows) {
    const std::vector<HourRows> hours = hours_of(rows);
    const std::size_t per_hour = most_rows(hours);
    const bool has_0 =
        std::any_of(rows.begin(), rows.end(), [](const EpwTime& row) { return row.hour == 0; });
    // The clock's hours begin at their minute 0, those of parts at most with it.
    const bool minute_0_first = std::all_of(hours.begin(), hours.end(), [&](const HourRows& hour) {
        return hour.count() != per_hour || rows[hour.begin].minute == 0;
    });
    if (!minute_0_first) return has_0 ? EpwHours::from_0 : EpwHours::from_1;
    const EpwTime &first = rows.front(), &last = rows.back();
    const bool first_lacks_0 =
        per_hour > 1 && first.minute != 0 && hours.front().count() < per_hour;
    const bool last_is_0 = per_hour > 1 && last.minute == 0 && hours.back().count() == 1;
    if (!has_0) return first_lacks_0 && last_is_0 ? EpwHours::ends : EpwHours::from_1;
    const bool has_24 =
        std::any_of(rows.begin(), rows.end(), [](const EpwTime& row) { return row.hour == 24; });
    if (has_24) return EpwHours::ends;
    if (is_midnight(first)) return is_midnight(last) ? EpwHours::ends : EpwHours::from_0;
    return first_lacks_0 || is_midnight(last) || last_is_0 ? EpwHours::ends : EpwHours::from_0;
}

std::vector<double> epw_ends(const std::vector<EpwTime>& rows, int declared,
                             std::vector<std::string>& notes) {
    const std::vector<HourRows> hours = hours_of(rows);
    const std::size_t most = most_rows(hours);
    const std::size_t per_hour = std::max<std::size_t>(most, declared > 0 ? declared : 1);
    if (declared > 0 && most != std::size_t(declared)) {
        notes.push_back(fmt::format(
            "DATA PERIODS declares {} rows per hour, but the file has up to {}", declared, most));
    }
    const EpwHours kind = epw_hours(rows);
    std::vector<double> ends;
    if (kind == EpwHours::ends) {
        notes.push_back(fmt::format(
            "its times are clock times at the end of each interval: the first is {}:{:02}",
            rows.front().hour, rows.front().minute));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const EpwTime& row = rows[i];
            // A day's last row may be its own 0:00.
            const bool late = i > 0 && is_midnight(row) && row.hour == 0 &&
                              rows[i - 1].day == row.day && rows[i - 1].month == row.month;
            ends.push_back(hour_seconds * (late ? 24 : row.hour) + 60.0 * row.minute);
        }
        return ends;
    }
    const int first_hour = kind == EpwHours::from_0 ? 0 : 1;
    if (first_hour == 0) {
        notes.push_back("its hours are 0 to 23: each begins an interval");
    }
    std::map<int, std::size_t> part_of_minute;  // as whole hours have it
    for (const HourRows& hour : hours) {
        if (hour.count() != per_hour) continue;
        for (std::size_t i = hour.begin; i < hour.end; ++i) {
            part_of_minute.try_emplace(rows[i].minute, i - hour.begin + 1);
        }
    }
    for (const HourRows& hour : hours) {
        for (std::size_t i = hour.begin; i < hour.end; ++i) {
            const EpwTime& row = rows[i];
            double part = double(i - hour.begin + 1);
            if (hour.count() != per_hour) {
                const auto known = part_of_minute.find(row.minute);
                part = known != part_of_minute.end()        ? double(known->second)
                       : row.minute == 0 && first_hour == 1 ? double(per_hour)
                                                            : row.minute / 60.0 * double(per_hour);
            }
            ends.push_back(hour_seconds * (row.hour - first_hour) +
                           hour_seconds * part / double(per_hour));
        }
    }
    return ends;
}

int epw_rows_per_hour(std::string_view data_periods) {
    const std::vector<std::string> cells = csv_cells(data_periods);
    double count = 0.0;
    if (cells.size() < 3 || !parse_number(cells[2], count)) return 0;
    const int whole = static_cast<int>(std::lround(std::clamp(count, 0.0, 60.0)));
    return whole > 0 && 60 % whole == 0 ? whole : 0;
}

}  // namespace diurna
