#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// Content of a column of times: the whole ("2021-07-08T13:30:00Z"), a date ("2021-07-08",
/// "20210708"), a time of day ("13:30", "13:30:05", "1330", "1:30 PM"), or a number of one part.
/// With _dmy the day comes first ("08.07.2021", "8/7/2021 13:30"), with _mdy the month
/// ("7/8/2021 1:30 PM").
enum class TimePart {
    whole,
    whole_dmy,
    whole_mdy,
    date,
    date_dmy,
    date_mdy,
    clock,
    year,
    month,
    day,
    day_of_year,
    hour,
    minute,
    second
};

/// From the words of [weather.columns]: time, time_dmy, time_mdy, date, date_dmy, date_mdy, clock,
/// year, month, day, day_of_year, hour, minute, second.
std::optional<TimePart> time_part_named(std::string_view word);
std::vector<std::string> time_part_names();

/// A part as given in a cell.
struct TimeCell {
    TimePart part;
    std::string text;
};

/// The instant from parts of a calendar `offset_h` ahead of UTC; hours may be 0 to 24 or have a
/// fraction, absent parts of the day are 0. Throws InputError(where) for a cell that is no such
/// part or a day that does not exist.
Instant instant_of_parts(std::span<const TimeCell> cells, double offset_h,
                         const std::string& where);

/// Throws InputError(where) unless the parts define one day: a date, or a year with month and day
/// or with day_of_year.
void check_time_parts(std::span<const TimePart> parts, const std::string& where);

}  // namespace diurna
