#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"
#include "thermal/weather_file/quantity.hpp"

namespace diurna {

/// A weather file as it was read: SI, rows ascending, NaN where a value is missing. Each reader of
/// this room makes one; gaps.hpp mends it and weather_series.hpp makes the Weather of it.
struct WeatherTable {
    std::filesystem::path file;
    std::string format;                // "EPW"
    std::vector<Instant> stamp{};      // (row)
    std::vector<std::string> where{};  // (row) "file:line"; an instant's index where there are none
    std::array<std::vector<double>, quantity_count> value{};  // [quantity](row); empty: not there
    std::optional<Stamp> stamps{};                            // what the format says of them
    /// Temperature, humidity, pressure, wind and cloud are of the stamp's instant, whatever
    /// interval the sums and means beside them are of.
    bool states_at_stamp = false;
    double wind_height = 10.0, air_height = 2.0;  // [m]
    std::optional<Geodetic> place{};              // of the station
    /// [s] from a row's stamp to the instant of its sunlight, where the file says that (PVGIS);
    /// `stamps` is then instant, and states of the stamps are taken from the line between them.
    double light_offset = 0.0;
    std::vector<std::string> notes{};  // what a reader of the report should know
    std::vector<Mistake> warnings{};   // what is implausible of the file or its place
    /// Columns that were passed over; one that looks like a quantity that is absent is warned of.
    std::vector<std::string> unused{};
    bool declarable = false;  // [weather.columns] may say what the columns are

    bool has(Quantity quantity) const { return !value[index(quantity)].empty(); }
    std::vector<double>& of(Quantity quantity) { return value[index(quantity)]; }
    const std::vector<double>& of(Quantity quantity) const { return value[index(quantity)]; }
};

/// Begins a row. Throws InputError unless it comes after the row before it.
void add_row(WeatherTable& table, Instant stamp, const std::string& where);
/// A value [SI] of the last row; NaN: missing. Throws InputError(where) outside the quantity's
/// range.
void put(WeatherTable& table, Quantity quantity, double value, const std::string& where);
/// Throws InputError for a value [SI] that no instrument has ever read.
/// declarable  the hint may advise [weather.columns], where columns of another unit are declared
/// read        the number as the file has it, in its own unit; NaN: the value
void check_range(Quantity quantity, double value, const std::string& where, bool declarable = false,
                 double read = std::numeric_limits<double>::quiet_NaN());

/// The interval between most rows [s]: the median; 0 for a lone row.
double usual_interval(const std::vector<Instant>& stamp);

/// Seconds into a local day of a calendar, `offset_h` ahead of UTC; hour 24 is the next day's 0.
/// Throws InputError(where) for a day that does not exist.
Instant local_instant(int year, int month, int day, double seconds, double offset_h,
                      const std::string& where);

}  // namespace diurna
