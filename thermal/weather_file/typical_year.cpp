#include "thermal/weather_file/typical_year.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

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

bool on(const LocalRow& row, int month, int day) { return row.month == month && row.day == day; }

/// The rows of a typical year in the order of a given one, each with its day of February there: a
/// leap day of the file goes by in common years; in leap years the day before represents one that
/// is not in the file.
std::vector<std::pair<std::size_t, int>> rows_of_year(const std::vector<LocalRow>& rows, int year) {
    const bool leap = std::chrono::year(year).is_leap();
    const bool has_leap_day =
        std::any_of(rows.begin(), rows.end(), [](const LocalRow& row) { return on(row, 2, 29); });
    std::vector<std::pair<std::size_t, int>> order;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (on(rows[i], 2, 29) && !leap) continue;
        order.emplace_back(i, rows[i].day);
        const bool last = i + 1 == rows.size() || !on(rows[i + 1], 2, 28);
        if (!leap || has_leap_day || !on(rows[i], 2, 28) || !last) continue;
        std::size_t first = i;
        while (first > 0 && on(rows[first - 1], 2, 28)) --first;
        for (std::size_t k = first; k <= i; ++k) order.emplace_back(k, 29);
    }
    return order;
}

int local_year(Instant instant, double offset_h) {
    using namespace std::chrono;
    const year_month_day date(floor<days>(later(instant, 3600.0 * offset_h)));
    return int(date.year());
}

}  // namespace

void add_local_rows(const std::vector<LocalRow>& rows, double offset_h, const AskedSpan& asked,
                    WeatherTable& table, const std::function<void(std::size_t)>& put_values,
                    bool declared_typical) {
    const auto add = [&](std::size_t i, int year, int day) {
        const LocalRow& row = rows[i];
        add_row(table, local_instant(year, row.month, day, row.seconds, offset_h, row.where),
                row.where);
        put_values(i);
    };
    if (!declared_typical && !typical(rows)) {
        for (std::size_t i = 0; i < rows.size(); ++i) add(i, rows[i].year, rows[i].day);
        return;
    }
    const int first = asked.any() ? local_year(asked.first(), offset_h) : rows.front().year;
    const int last = asked.any() ? local_year(asked.last(), offset_h) : first;
    for (int year = first; year <= last; ++year) {
        for (const auto& [i, day] : rows_of_year(rows, year)) add(i, year, day);
    }
    table.notes.push_back(fmt::format(
        "a typical year with months of several years, used for {}",
        first == last ? fmt::format("{}", first) : fmt::format("{} to {}", first, last)));
}

}  // namespace diurna
