#include "thermal/weather_file/era5_sums.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

namespace {

constexpr double one_hour = 3600.0;     // [s]
constexpr double most_of_hour = 5.4e6;  // [J m⁻²] 1500 W m⁻² over an hour
constexpr double packing = 2e-3;        // of the largest sum: what packed values differ by
constexpr std::array sums{"ssrd", "strd", "fdir", "tp"};

/// Hours since midnight UTC, 1 to 24, at the end of which a stamp is.
int hours_summed(Instant stamp) {
    const auto day = std::chrono::floor<std::chrono::days>(stamp);
    const int hour = int(std::lround(seconds_between(Instant(day), stamp) / one_hour));
    return hour == 0 ? 24 : hour;
}

constexpr int longest = 12;  // [h] between rows whose sums are taken apart

/// Hours from the row before to row i, if that is within the sums of one day; else 0.
int hours_since(const Era5Series& series, std::size_t i) {
    if (i == 0) return 0;
    const int hours =
        int(std::lround(seconds_between(series.stamp[i - 1], series.stamp[i]) / one_hour));
    const int summed = hours_summed(series.stamp[i]);
    return hours >= 1 && hours <= longest && hours < summed ? hours : 0;
}
bool goes_on(const Era5Series& series, std::size_t i) { return hours_since(series, i) > 0; }

/// Usual hours between rows, at least 1.
int usual_hours(const Era5Series& series) {
    return std::max(1, int(std::lround(usual_interval(series.stamp) / one_hour)));
}

double largest_of(const std::vector<double>& column) {
    double largest = 0.0;
    for (const double value : column) {
        if (!std::isnan(value)) largest = std::max(largest, value);
    }
    return largest;
}

bool grows_through_days(const Era5Series& series, const std::vector<double>& column) {
    const double slack = packing * largest_of(column);
    for (std::size_t i = 1; i < column.size(); ++i) {
        if (goes_on(series, i) && column[i] < column[i - 1] - slack) return false;
    }
    return true;
}

}  // namespace

void take_sums_apart(Era5Series& series) {
    bool too_large = false;
    for (const char* name : {"ssrd", "strd", "fdir"}) {
        const auto found = series.values.find(name);
        if (found == series.values.end()) continue;
        too_large |= largest_of(found->second) > most_of_hour;
        if (!grows_through_days(series, found->second)) return;
    }
    if (!too_large) return;
    const int usual = usual_hours(series);
    for (const char* name : sums) {
        const auto found = series.values.find(name);
        if (found == series.values.end()) continue;
        const std::vector<double> sum = found->second;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const int since = hours_since(series, i), summed = hours_summed(series.stamp[i]);
            if (since > 0) {
                found->second[i] = std::max(0.0, sum[i] - sum[i - 1]) / since;
            } else {  // the first sum of a day, from midnight on
                found->second[i] = summed <= usual ? sum[i] / summed : not_measured;
            }
        }
    }
    series.notes.push_back(
        usual == 1 ? "radiation and rain are sums since midnight UTC, as in ERA5-Land, and are "
                     "converted to hourly values"
                   : "radiation and rain are sums since midnight UTC, as in ERA5-Land, and are "
                     "converted to means between the rows");
    series.between_rows = true;
}

}  // namespace diurna
