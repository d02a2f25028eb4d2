#pragma once

#include <functional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// The years that a weather is wanted for; empty: as the file says.
struct AskedSpan {
    Instant begin{}, end{};
    /// [s] of the weather before and behind that is used too, where a file has it: the days that a
    /// start is found from.
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

/// Puts rows of a local calendar into a table: `put_values(i)` puts those of row i, after its stamp
/// was added.
///
/// Files of a typical year (EPW, TMY3) take each month from another year. Where the years of rows
/// change otherwise than at New Year, the rows stand for every year that the span asked for
/// touches (without one: for the year of the first row), and a note says so. Such years have no 29
/// February; in a leap year the 28th stands for it too.
///
/// declared_typical  the file says that it is one, whatever its years
void add_local_rows(const std::vector<LocalRow>& rows, double offset_h, const AskedSpan& asked,
                    WeatherTable& table, const std::function<void(std::size_t)>& put_values,
                    bool declared_typical = false);

}  // namespace diurna
