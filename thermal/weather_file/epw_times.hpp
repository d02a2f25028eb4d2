#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// The time fields of an EPW row: hour 1 to 24, and a minute that files count differently.
struct EpwTime {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0;
};

/// How a file counts its hours.
///
/// - from_1: hour h is the time from h − 1 to h o'clock, 1 to 24, as EPW files should have it
/// - from_0: hour h is the time from h to h + 1 o'clock, 0 to 23
/// - ends: hour and minute are the clock time at the end of the row's interval: 0:30, 1:00,
///   ... 24:00, or 0:00 of the next day
enum class EpwHours { from_1, from_0, ends };

/// Which of them a file uses: from hours of 0, from the first minute of complete hours, and from
/// its first and last rows.
EpwHours epw_hours(const std::vector<EpwTime>& rows);

/// End of each row's interval, [s] of its day; for hours from_1 and from_0:
///
/// In an hour with n rows the k-th row in the file's order is its k-th part, whatever its minute:
/// files write 0, 10, ... 50 as well as 10, 20, ... 60 (or 0 for the last). In hours with missing
/// rows, a minute has the same meaning as in complete ones.
///
/// declared  rows per hour by the file's DATA PERIODS; 0: not given
/// notes     gets a line if the file has another number, and if hours are not from_1
std::vector<double> epw_ends(const std::vector<EpwTime>& rows, int declared,
                             std::vector<std::string>& notes);

/// Rows per hour by a line "DATA PERIODS,1,6,..."; 0 without such a number.
int epw_rows_per_hour(std::string_view data_periods);

}  // namespace diurna
