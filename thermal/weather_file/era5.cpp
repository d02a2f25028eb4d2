#include "thermal/weather_file/era5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "thermal/weather_file/era5_sums.hpp"
#include "thermal/weather_file/joined_rows.hpp"

namespace diurna {

namespace {

constexpr double hour = 3600.0;  // [s]

/// Throws InputError where a flux is more than an hour can bring: then it is a longer sum.
void check_hourly(const WeatherTable& table, const std::string& name, double flux,
                  std::size_t row) {
    if (!(flux > 1500.0)) return;
    throw InputError(
        table.where[row],
        fmt::format("found {:.0f} J/m2 of {}, more than one hour can have", flux * hour, name),
        "sums over more than an hour are converted only if they increase from 01:00 to 00:00 UTC "
        "every hour, as in ERA5-Land");
}

}  // namespace

const std::vector<std::string>& era5_names() {
    static const std::vector<std::string> names{"t2m",  "d2m",  "u10",  "v10", "si10", "sp",
                                                "ssrd", "strd", "fdir", "tp",  "tcc"};
    return names;
}

bool is_era5_name(const std::string& name) {
    return std::find(era5_names().begin(), era5_names().end(), name) != era5_names().end();
}

void add_stamp(Era5Series& series, Instant stamp, const std::string& where) {
    if (!series.stamp.empty() && stamp <= series.stamp.back()) {
        throw InputError(
            where, fmt::format("{} is not later than the previous row", format_instant(stamp)));
    }
    series.stamp.push_back(stamp);
    series.where.push_back(where);
}

void join_era5(Era5Series& all, const Era5Series& more) {
    constexpr double same_place_deg = 0.01;
    if (all.place && more.place &&
        (std::abs(all.place->latitude_deg - more.place->latitude_deg) > same_place_deg ||
         std::abs(all.place->longitude_deg - more.place->longitude_deg) > same_place_deg)) {
        throw InputError(
            more.file.string(),
            fmt::format("is at {:.2f} N {:.2f} E, {} at {:.2f} N {:.2f} E",
                        more.place->latitude_deg, more.place->longitude_deg, all.file.string(),
                        all.place->latitude_deg, all.place->longitude_deg),
            "all files of a list must have the same place");
    }
    if (!all.place) all.place = more.place;
    const JoinedRows rows = joined_rows(all.stamp, more.stamp);
    std::vector<std::string> where;
    for (std::size_t i = 0; i < rows.stamp.size(); ++i) {
        where.push_back(rows.first[i] != no_row ? all.where[rows.first[i]]
                                                : more.where[rows.second[i]]);
    }
    Era5Values values;
    for (const std::string& name : era5_names()) {
        const auto a = std::as_const(all.values).find(name);
        const auto b = more.values.find(name);
        if (a == all.values.cend() && b == more.values.end()) continue;
        std::vector<double>& column = values[name];
        for (std::size_t i = 0; i < rows.stamp.size(); ++i) {
            double value = not_measured;
            if (a != all.values.cend() && rows.first[i] != no_row) value = a->second[rows.first[i]];
            if (std::isnan(value) && b != more.values.end() && rows.second[i] != no_row) {
                value = b->second[rows.second[i]];
            }
            column.push_back(value);
        }
    }
    all.stamp = rows.stamp;
    all.where = std::move(where);
    all.values = std::move(values);
    for (const std::string& note : more.notes) {
        if (std::find(all.notes.begin(), all.notes.end(), note) == all.notes.end()) {
            all.notes.push_back(note);
        }
    }
    all.unused.insert(all.unused.end(), more.unused.begin(), more.unused.end());
}

WeatherTable era5_table(Era5Series series) {
    take_sums_apart(series);
    const Era5Values& values = series.values;
    WeatherTable table{.file = series.file, .format = series.format};
    for (std::size_t i = 0; i < series.stamp.size(); ++i) {
        add_row(table, series.stamp[i], series.where[i]);
    }
    table.place = series.place;
    table.notes = series.notes;
    table.unused = series.unused;
    table.stamps = Stamp::end;
    table.states_at_stamp = true;
    const auto take = [&](const char* name, Quantity quantity, double factor) {
        const auto found = values.find(name);
        if (found == values.end()) return;
        std::vector<double>& column = table.of(quantity);
        for (std::size_t i = 0; i < found->second.size(); ++i) {
            column.push_back(factor * found->second[i]);
            if (factor == 1.0 / hour) check_hourly(table, name, column.back(), i);
            check_range(quantity, column.back(), table.where[i]);
        }
    };
    take("t2m", Quantity::air_temperature, 1.0);
    take("d2m", Quantity::dew_point, 1.0);
    take("sp", Quantity::pressure, 1.0);
    take("tcc", Quantity::cloud_fraction, 1.0);
    take("ssrd", Quantity::shortwave_down, 1.0 / hour);
    take("strd", Quantity::longwave_down, 1.0 / hour);
    take("tp", Quantity::rain, 1000.0);
    const auto u = values.find("u10"), v = values.find("v10");
    if (u != values.end() && v != values.end()) {
        for (std::size_t i = 0; i < u->second.size(); ++i) {
            table.of(Quantity::wind_speed).push_back(std::hypot(u->second[i], v->second[i]));
        }
    }
    if (!table.has(Quantity::wind_speed)) take("si10", Quantity::wind_speed, 1.0);
    const auto beam = values.find("fdir");
    if (beam != values.end() && table.has(Quantity::shortwave_down)) {
        for (std::size_t i = 0; i < beam->second.size(); ++i) {
            const double global = table.of(Quantity::shortwave_down)[i];
            table.of(Quantity::diffuse).push_back(std::max(0.0, global - beam->second[i] / hour));
        }
    }
    if (!table.has(Quantity::air_temperature)) {
        throw InputError(table.file.string(), "has no t2m, the air temperature",
                         "the data store separates accumulated and instantaneous variables: set "
                         "weather.file to both, [\"instant.nc\", \"accum.nc\"], or to its zip");
    }
    const double usual = usual_interval(table.stamp);
    const bool radiation =
        table.has(Quantity::shortwave_down) || table.has(Quantity::longwave_down);
    if (usual > 1.5 * hour && radiation && !series.between_rows) {
        table.stamps = Stamp::instant;
        table.light_offset = -0.5 * hour;
        table.notes.push_back(
            fmt::format("ERA5's radiation is that of the last hour of each {:g} h: it is used as "
                        "that of 30 min before the stamp, with interpolation between; hourly data "
                        "or ERA5-Land are better",
                        usual / hour));
    }
    return table;
}

}  // namespace diurna
