#include "thermal/weather_file/read_weather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/station_warnings.hpp"
#include "thermal/weather_file/unused_columns.hpp"
#include "thermal/weather_file/weather_files.hpp"
#include "thermal/weather_file/weather_series.hpp"

namespace diurna {

namespace {

constexpr double longest_hold = 86400.0;  // [s] beyond the file's ends

const char* name_of(Stamp stamp) {
    if (stamp == Stamp::instant) return "instant";
    return stamp == Stamp::start ? "start" : "end";
}

Stamp stamps_of(const WeatherTable& table, const WeatherOptions& options) {
    if (table.stamps && options.interval && *table.stamps != *options.interval) {
        throw InputError(
            options.where,
            fmt::format("found '{}', but the stamps of {} files mean '{}'",
                        name_of(*options.interval), table.format, name_of(*table.stamps)),
            "remove the key");
    }
    return options.interval.value_or(table.stamps.value_or(Stamp::end));
}

/// Throws InputError unless a file covers the requested span; notes where it just does not.
void check_cover(WeatherTable& table, Stamp stamps, const AskedSpan& asked) {
    if (!asked.any()) return;
    const CoveredSpan span = covered_span(table, stamps);
    const double slack = std::min(usual_interval(table.stamp), longest_hold);
    const double early = seconds_between(asked.begin, span.begin);
    const double late = seconds_between(span.end, asked.end);
    if (early > slack || late > slack) {
        throw InputError(table.file.string(),
                         fmt::format("has weather from {} to {}, expected {} to {}",
                                     format_instant(span.begin), format_instant(span.end),
                                     format_instant(asked.begin), format_instant(asked.end)));
    }
    if (early > 0.0) {
        table.notes.push_back(fmt::format(
            "the file begins {:g} min after the span; its first row is used before", early / 60.0));
    }
    if (late > 0.0) {
        table.notes.push_back(fmt::format(
            "the file ends {:g} min before the end of the span; its last row is used after",
            late / 60.0));
    }
}

/// Refuses pressures that no place on the ground has, unless they are the standard atmosphere's at
/// that height: most are of another unit.
///
/// height  [m] above the sea, of the instruments
void check_pressure(const WeatherTable& table, double height) {
    constexpr double least = 30000.0, most = 110000.0, near = 0.1;  // [Pa]; a share
    const double usual = standard_pressure(height);
    const auto fits = [&](double pressure) {
        return (pressure >= least && pressure <= most) ||
               std::abs(pressure - usual) <= near * usual;
    };
    const std::vector<double>& all = table.of(Quantity::pressure);
    for (std::size_t row = 0; row < all.size(); ++row) {
        if (std::isnan(all[row]) || fits(all[row])) continue;
        std::string hint;
        if (!table.declarable) hint = "check whether the file is damaged or was converted wrongly";
        for (const auto& [unit, pascal] : {std::pair{"hPa", 100.0}, {"kPa", 1000.0}}) {
            if (!table.declarable || std::abs(all[row] * pascal - usual) > 2.0 * near * usual) {
                continue;
            }
            hint = fmt::format(
                "seems to be {}: pressure_Pa is in Pa; declare the unit in [weather.columns]: "
                "\"pressure {}\"",
                unit, unit);
        }
        throw InputError(table.where[row] + ": pressure_Pa",
                         fmt::format("found {:g} Pa, expected {:g} to {:g} at the station (the "
                                     "standard atmosphere has {:.0f} at its {:g} m)",
                                     all[row], least, most, usual, height),
                         hint);
    }
}

}  // namespace

Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options) {
    return read_weather(std::span(&file, 1), options);
}

Weather read_weather(std::span<const std::filesystem::path> files, const WeatherOptions& options) {
    WeatherTable table = read_weather_tables(files, options);
    const Stamp stamps = stamps_of(table, options);
    table.wind_height = options.wind_height.value_or(table.wind_height);
    table.air_height = options.air_height.value_or(table.air_height);
    check_cover(table, stamps, options.asked);
    warn_of_unused_columns(table);
    warn_of_place(table, {.site = options.site,
                          .elevation = options.elevation,
                          .height_named = options.height.has_value(),
                          .carried = options.at_station});
    fill_gaps(table, options.on_gap, options.asked, options.site);
    const bool carried = options.at_station && table.place && std::isfinite(table.place->height);
    const double height =
        options.height.value_or(carried ? table.place->height : options.elevation);
    check_pressure(table, height);
    Weather weather = weather_series(table, stamps, height);
    weather.height = height;
    weather.carried = options.at_station;
    change_weather(weather, options.change, options.where_changed);
    return weather;
}

}  // namespace diurna
