#include "thermal/weather_file/typical_year.hpp"

#include <fmt/format.h>

#include <chrono>

namespace diurna {

namespace {

bool typical(const std::vector<LocalRow>& rows) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const LocalRow &before = rows[i - 1], &row = rows[i];
        const bool new_year = before.month == 12 && row.month == 1 && row.year == before.year + 1;
        if (row.year != before.year && !new_year) return true;
    }
    return false;
}

int local_year(Instant instant, double offset_h) {
    using namespace std::chrono;
    const year_month_day date(floor<days>(later(instant, 3600.0 * offset_h)));
    return int(date.year());
}

}  // namespace

void add_local_rows(const std::vector<LocalRow>& rows, double offset_h, const AskedSpan& asked,
                    WeatherTable& table, const std::function<void(std::size_t)>& put_values) {
    const auto add = [&](std::size_t i, int year) {
        const LocalRow& row = rows[i];
        add_row(table, local_instant(year, row.month, row.day, row.seconds, offset_h, row.where),
                row.where);
        put_values(i);
    };
    if (!typical(rows)) {
        for (std::size_t i = 0; i < rows.size(); ++i) add(i, rows[i].year);
        return;
    }
    const int first = asked.any() ? local_year(asked.first(), offset_h) : rows.front().year;
    const int last = asked.any() ? local_year(asked.last(), offset_h) : first;
    for (int year = first; year <= last; ++year) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const bool leap_day = rows[i].month == 2 && rows[i].day == 29;
            if (leap_day && !std::chrono::year(year).is_leap()) continue;
            add(i, year);
        }
    }
    table.notes.push_back(fmt::format(
        "a typical year, its months of several years, taken for {}",
        first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last)));
}

}  // namespace diurna
