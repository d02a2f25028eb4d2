#pragma once

#include <functional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The span for which a weather is requested; empty: that of the file.
struct AskedSpan {
    Instant begin{}, end{};
    /// [s] of the weather before and after it that are used too, if a file has them: the days for
    /// computing a start.
    double before = 0.0, behind = 0.0;
    bool any() const { return begin < end; }
    Instant first() const { return later(begin, -before); }
    Instant last() const { return later(end, behind); }
};

/// A row of a calendar kept in local standard time. Its stamp is `seconds` of the day.
struct LocalRow {
    int year = 0, month = 0, day = 0;
    double seconds = 0.0;
    std::string where;
};

/// Adds rows of a local calendar to a table: `put_values(i)` adds the values of row i, after its
/// stamp was added.
///
/// Files of a typical year (EPW, TMY3) take each month from another year. If the years of rows
/// change other than at New Year, the rows are used for every year of the requested span (without
/// one: for the year of the first row), and a note says so. Such years have no 29 February; in a
/// leap year the 28th is used for it too.
///
/// declared_typical  the file declares itself typical, whatever its years
void add_local_rows(const std::vector<LocalRow>& rows, double offset_h, const AskedSpan& asked,
                    WeatherTable& table, const std::function<void(std::size_t)>& put_values,
                    bool declared_typical = false);

}  // namespace diurna
