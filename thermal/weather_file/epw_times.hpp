#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// The times of an EPW row as they stand: hour 1 to 24, and a minute that files count differently.
struct EpwTime {
    int year = 0, month = 0, day = 0, hour = 0, minute = 0;
};

/// When each row's interval ends, [s] of its day.
///
/// Hour h is the time from h − 1 to h o'clock. Of an hour with n rows the k-th row in the file's
/// order is its k-th part, whatever its minute says: files write 0, 10, ... 50 as well as 10, 20,
/// ... 60 (or 0 for the last). In hours that lack rows, a minute means what it means in whole ones.
///
/// declared  rows per hour by the file's DATA PERIODS; 0: it does not say
/// notes     gets a line where the file has another number
std::vector<double> epw_ends(const std::vector<EpwTime>& rows, int declared,
                             std::vector<std::string>& notes);

/// Rows per hour by a line "DATA PERIODS,1,6,..."; 0 where it names no such number.
int epw_rows_per_hour(std::string_view data_periods);

}  // namespace diurna
