#include "thermal/weather_file/weather_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "thermal/weather_file/bsrn.hpp"
#include "thermal/weather_file/epw.hpp"
#include "thermal/weather_file/era5_files.hpp"
#include "thermal/weather_file/joined_rows.hpp"
#include "thermal/weather_file/psm.hpp"
#include "thermal/weather_file/pvgis.hpp"
#include "thermal/weather_file/solar_anywhere.hpp"
#include "thermal/weather_file/station_warnings.hpp"
#include "thermal/weather_file/surfrad.hpp"
#include "thermal/weather_file/tmy3.hpp"
#include "thermal/weather_file/weather_format.hpp"

namespace diurna {

namespace {

constexpr double same_station_km = 1.0;

bool is_era5(WeatherFormat format) {
    return format == WeatherFormat::era5_csv || format == WeatherFormat::era5_netcdf ||
           format == WeatherFormat::era5_zip;
}

/// Of the site, if it is known.
std::optional<Geodetic> place_of(const WeatherOptions& options) {
    if (!options.site) return std::nullopt;
    return Geodetic{options.site->latitude_deg, options.site->longitude_deg, 0.0};
}

void check_same_kind(const WeatherTable& all, const WeatherTable& more) {
    if (all.format != more.format || all.stamps != more.stamps ||
        all.light_offset != more.light_offset) {
        throw InputError(more.file.string(),
                         fmt::format("is {}, {} is {}", more.format, all.file.string(), all.format),
                         "all files of a list must have the same format");
    }
    if (all.place && more.place && distance_km(*all.place, *more.place) > same_station_km) {
        throw InputError(more.file.string(),
                         fmt::format("is from a station {:.0f} km from that of {}",
                                     distance_km(*all.place, *more.place), all.file.string()),
                         "all files of a list must be from one station");
    }
}

/// Adds the rows of another table.
void join_table(WeatherTable& all, const WeatherTable& more) {
    check_same_kind(all, more);
    const JoinedRows rows = joined_rows(all.stamp, more.stamp);
    const auto twice = std::count_if(rows.stamp.begin(), rows.stamp.end(), [&](const Instant& at) {
        const auto i = std::size_t(&at - rows.stamp.data());
        return rows.first[i] != no_row && rows.second[i] != no_row;
    });
    if (twice > 0) {
        all.notes.push_back(fmt::format(
            "{} in {} and in an earlier file of the list; the earlier file's values are used",
            number_of(twice, "instant is", "instants are"), more.file.string()));
    }
    std::vector<std::string> where;
    for (std::size_t i = 0; i < rows.stamp.size(); ++i) {
        where.push_back(rows.first[i] != no_row ? all.where[rows.first[i]]
                                                : more.where[rows.second[i]]);
    }
    for (std::size_t q = 0; q < quantity_count; ++q) {
        const std::vector<double>&a = all.value[q], &b = more.value[q];
        if (a.empty() && b.empty()) continue;
        std::vector<double> column;
        for (std::size_t i = 0; i < rows.stamp.size(); ++i) {
            double value = not_measured;
            if (!a.empty() && rows.first[i] != no_row) value = a[rows.first[i]];
            if (!b.empty() && std::isnan(value) && rows.second[i] != no_row) {
                value = b[rows.second[i]];
            }
            column.push_back(value);
        }
        all.value[q] = std::move(column);
    }
    all.stamp = rows.stamp;
    all.where = std::move(where);
    for (const std::string& note : more.notes) {
        if (std::find(all.notes.begin(), all.notes.end(), note) == all.notes.end()) {
            all.notes.push_back(note);
        }
    }
    for (const std::string& name : more.unused) {
        if (std::find(all.unused.begin(), all.unused.end(), name) == all.unused.end()) {
            all.unused.push_back(name);
        }
    }
}

}  // namespace

WeatherTable read_weather_table(const std::filesystem::path& file, const WeatherOptions& options) {
    const WeatherFormat format = weather_format(file);
    if (format != WeatherFormat::csv && format != WeatherFormat::era5_csv &&
        !options.columns.empty()) {
        throw InputError(
            file.string(),
            "has a format with its own columns; [weather.columns] applies to CSV only");
    }
    if (format != WeatherFormat::csv && !options.missing.empty()) {
        throw InputError(
            options.where_missing,
            fmt::format("{} has its own codes for missing values", file.filename().string()),
            "remove the key");
    }
    switch (format) {
        case WeatherFormat::epw:
            return read_epw(file, options.asked);
        case WeatherFormat::tmy3:
            return read_tmy3(file, options.asked);
        case WeatherFormat::psm:
            return read_psm(file, options.asked);
        case WeatherFormat::pvgis:
            return read_pvgis(file, options.asked);
        case WeatherFormat::solar_anywhere:
            return read_solar_anywhere(file, options.asked);
        case WeatherFormat::surfrad:
            return read_surfrad(file);
        case WeatherFormat::bsrn:
            return read_bsrn(file);
        case WeatherFormat::era5_netcdf:
        case WeatherFormat::era5_zip:
            return era5_table(read_era5_series(file, place_of(options)));
        case WeatherFormat::era5_csv:
            if (options.columns.empty())
                return era5_table(read_era5_series(file, place_of(options)));
            [[fallthrough]];
        case WeatherFormat::csv:
            break;
    }
    return read_own_csv(file, options.columns, options.missing, options.skip_lines);
}

WeatherTable read_weather_tables(std::span<const std::filesystem::path> files,
                                 const WeatherOptions& options) {
    if (files.empty()) throw InputError(options.where_file, "names no file");
    if (files.size() == 1) return read_weather_table(files.front(), options);
    const bool all_era5 =
        options.columns.empty() && std::all_of(files.begin(), files.end(), [](const auto& file) {
            return is_era5(weather_format(file));
        });
    if (all_era5) {
        Era5Series all = read_era5_series(files.front(), place_of(options));
        for (const auto& file : files.subspan(1))
            join_era5(all, read_era5_series(file, place_of(options)));
        return era5_table(all);
    }
    WeatherTable all = read_weather_table(files.front(), options);
    for (const auto& file : files.subspan(1)) join_table(all, read_weather_table(file, options));
    all.notes.insert(all.notes.begin(), fmt::format("{} files are joined", files.size()));
    return all;
}

}  // namespace diurna
