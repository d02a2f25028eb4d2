#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "thermal/weather_file/time_parts.hpp"
#include "thermal/weather_file/weather_table.hpp"

namespace diurna {

/// Content of a column of a user's CSV: a quantity in a unit, or the time or a part of it.
struct DeclaredColumn {
    std::string name;                    // in the file's header
    std::optional<Quantity> quantity{};  // none: the time
    Unit unit{};
    TimePart part = TimePart::whole;                             // of the time
    double offset_h = std::numeric_limits<double>::quiet_NaN();  // from UTC, of the time; NaN: its
                                                                 // cells
};

/// "air_temperature degC", "time UTC", "year -07:00", "hour": a quantity and its unit, or the time
/// or a part of it with its offset, as [weather.columns] declares them.
/// Throws InputError(where) with the allowed words.
DeclaredColumn declared_column(const std::string& name, const std::string& says,
                               const std::string& where);

/// The cells of a table of weather: with ',', ';', tabs or blanks between them, without the lines
/// that known services put above the header. `separator` is "" for commas, else it describes it.
CsvTable weather_cells(const std::filesystem::path& file, int skip_lines, std::string& separator);

/// A CSV file with the program's own columns (thermal/weather_file/README.md) and additional
/// declared ones. If columns are declared, others are skipped and named in a note, and cells "M"
/// are missing like empty ones and "NA", "null" and "nan"; if none are, unknown columns are
/// mistakes. A time may be split over several columns (time_parts.hpp).
///
/// missing     numbers that mark missing values, as in the file: -9999
/// skip_lines  above the header; those of Open-Meteo and NASA POWER are known
WeatherTable read_own_csv(const std::filesystem::path& file,
                          const std::vector<DeclaredColumn>& declared,
                          const std::vector<double>& missing = {}, int skip_lines = 0);

}  // namespace diurna
