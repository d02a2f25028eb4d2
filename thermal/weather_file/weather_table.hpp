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

/// A weather file as read: SI, rows ascending, NaN for missing values. Every reader here returns
/// one; gaps.hpp fills it and weather_series.hpp makes the Weather from it.
struct WeatherTable {
    std::filesystem::path file;
    std::string format;                // "EPW"
    std::vector<Instant> stamp{};      // (row)
    std::vector<std::string> where{};  // (row) "file:line"; else an instant's index
    std::array<std::vector<double>, quantity_count> value{};  // [quantity](row); empty: absent
    std::optional<Stamp> stamps{};                            // as defined by the format
    /// Temperature, humidity, pressure, wind and cloud are those at the stamp's instant, whatever
    /// the interval of the sums and means.
    bool states_at_stamp = false;
    double wind_height = 10.0, air_height = 2.0;  // [m]
    std::optional<Geodetic> place{};              // of the station
    /// [s] from a row's stamp to the instant of its sunlight, if the file gives it (PVGIS);
    /// `stamps` is then instant, and states at the stamps are interpolated.
    double light_offset = 0.0;
    std::vector<std::string> notes{};  // for the report
    std::vector<Mistake> warnings{};   // implausible values of the file or its place
    /// Skipped columns; a warning is given for one that resembles an absent quantity.
    std::vector<std::string> unused{};
    bool declarable = false;  // [weather.columns] can declare the columns

    bool has(Quantity quantity) const { return !value[index(quantity)].empty(); }
    std::vector<double>& of(Quantity quantity) { return value[index(quantity)]; }
    const std::vector<double>& of(Quantity quantity) const { return value[index(quantity)]; }
};

/// Begins a row. Throws InputError unless it is later than the previous row.
void add_row(WeatherTable& table, Instant stamp, const std::string& where);
/// A value [SI] of the last row; NaN: missing. Throws InputError(where) outside the quantity's
/// range.
void put(WeatherTable& table, Quantity quantity, double value, const std::string& where);
/// Throws InputError for a value [SI] beyond all records.
/// declarable  the hint may suggest [weather.columns], where other units can be declared
/// read        the number in the file, in its own unit; NaN: the value
void check_range(Quantity quantity, double value, const std::string& where, bool declarable = false,
                 double read = std::numeric_limits<double>::quiet_NaN());

/// The most frequent interval between rows [s]: the median; 0 for a single row.
double usual_interval(const std::vector<Instant>& stamp);

/// Seconds into a local day of a calendar, `offset_h` ahead of UTC; hour 24 is the next day's 0.
/// Throws InputError(where) for a day that does not exist.
Instant local_instant(int year, int month, int day, double seconds, double offset_h,
                      const std::string& where);

}  // namespace diurna
