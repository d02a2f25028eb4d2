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

}  // namespace

std::vector<double> epw_ends(const std::vector<EpwTime>& rows, int declared,
                             std::vector<std::string>& notes) {
    const std::vector<HourRows> hours = hours_of(rows);
    std::size_t most = 1;
    for (const HourRows& hour : hours) most = std::max(most, hour.count());
    const std::size_t per_hour = std::max<std::size_t>(most, declared > 0 ? declared : 1);
    if (declared > 0 && most != std::size_t(declared)) {
        notes.push_back(fmt::format("DATA PERIODS declares {} rows an hour, the file has up to {}",
                                    declared, most));
    }
    std::map<int, std::size_t> part_of_minute;  // as whole hours have it
    for (const HourRows& hour : hours) {
        if (hour.count() != per_hour) continue;
        for (std::size_t i = hour.begin; i < hour.end; ++i) {
            part_of_minute.try_emplace(rows[i].minute, i - hour.begin + 1);
        }
    }
    std::vector<double> ends;
    for (const HourRows& hour : hours) {
        for (std::size_t i = hour.begin; i < hour.end; ++i) {
            const EpwTime& row = rows[i];
            double part = double(i - hour.begin + 1);
            if (hour.count() != per_hour) {
                const auto known = part_of_minute.find(row.minute);
                part = known != part_of_minute.end() ? double(known->second)
                       : row.minute == 0             ? double(per_hour)
                                                     : row.minute / 60.0 * double(per_hour);
            }
            ends.push_back(hour_seconds * (row.hour - 1 + part / double(per_hour)));
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
