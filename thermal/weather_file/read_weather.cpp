#include "thermal/weather_file/read_weather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/bsrn.hpp"
#include "thermal/weather_file/epw.hpp"
#include "thermal/weather_file/era5_csv.hpp"
#include "thermal/weather_file/era5_netcdf.hpp"
#include "thermal/weather_file/surfrad.hpp"
#include "thermal/weather_file/text_lines.hpp"
#include "thermal/weather_file/tmy3.hpp"
#include "thermal/weather_file/weather_series.hpp"

namespace diurna {

namespace {

constexpr double longest_hold = 86400.0;  // [s] beyond the file's ends
constexpr double far_km = 50.0, far_up_m = 300.0;

/// The first bytes of a file; empty if it cannot be read (the readers tell why).
std::string head_of(const std::filesystem::path& file) {
    constexpr std::size_t enough = 8192;
    std::string head(enough, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), std::streamsize(enough));
    head.resize(std::size_t(std::max<std::streamsize>(0, in.gcount())));
    return head.starts_with(byte_order_mark) ? head.substr(byte_order_mark.size()) : head;
}

std::string line_of(const std::string& text, int number) {
    std::size_t begin = 0;
    for (; number > 0 && begin != std::string::npos; --number) {
        begin = text.find('\n', begin);
        if (begin != std::string::npos) ++begin;
    }
    return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

/// "  37.70  105.92 2317 m version 1"
bool is_surfrad_station(const std::string& line) {
    const std::vector<std::string_view> words = words_of(line);
    return words.size() >= 4 && words[3] == "m" && line.find("version") != std::string::npos;
}

bool is_netcdf(const std::string& head) {
    return head.starts_with("CDF") || head.starts_with("\x89HDF");
}

WeatherFormat format_of_content(const std::string& head) {
    if (is_netcdf(head)) return WeatherFormat::era5_netcdf;
    const std::string first = line_of(head, 0), second = line_of(head, 1);
    if (first.starts_with("LOCATION,")) return WeatherFormat::epw;
    if (second.starts_with("Date (MM/DD/YYYY),Time (HH:MM)")) return WeatherFormat::tmy3;
    if (first.starts_with("*U0001") || first.starts_with("*C0001")) return WeatherFormat::bsrn;
    if (is_surfrad_station(second)) return WeatherFormat::surfrad;
    if (first.find("valid_time") != std::string::npos && first.find("t2m") != std::string::npos) {
        return WeatherFormat::era5_csv;
    }
    return WeatherFormat::csv;
}

const char* name_of(Stamp stamp) {
    if (stamp == Stamp::instant) return "instant";
    return stamp == Stamp::start ? "start" : "end";
}

Stamp stamps_of(const WeatherTable& table, const WeatherOptions& options) {
    if (table.stamps && options.interval && *table.stamps != *options.interval) {
        throw InputError(
            options.where,
            fmt::format("found '{}', but stamps of {} files are '{}'", name_of(*options.interval),
                        table.format, name_of(*table.stamps)),
            "leave the key out");
    }
    return options.interval.value_or(table.stamps.value_or(Stamp::end));
}

/// Throws InputError unless a file covers what was asked for; notes where it just does not.
void check_cover(WeatherTable& table, Stamp stamps, const AskedSpan& asked) {
    if (!asked.any()) return;
    const CoveredSpan span = covered_span(table, stamps);
    const double slack = std::min(usual_interval(table.stamp), longest_hold);
    const double early = seconds_between(asked.begin, span.begin);
    const double late = seconds_between(span.end, asked.end);
    if (early > slack || late > slack) {
        throw InputError(table.file.string(),
                         fmt::format("holds weather from {} to {}; asked for {} to {}",
                                     format_instant(span.begin), format_instant(span.end),
                                     format_instant(asked.begin), format_instant(asked.end)));
    }
    if (early > 0.0) {
        table.notes.push_back(
            fmt::format("the file begins {:g} min after the span; its first row is held before it",
                        early / 60.0));
    }
    if (late > 0.0) {
        table.notes.push_back(fmt::format(
            "the file ends {:g} min before the span; its last row is held behind it", late / 60.0));
    }
}

/// Where a station is far from the place it stands for.
void tell_place(WeatherTable& table, const WeatherOptions& options) {
    if (!table.place || !options.site) return;
    const double north = radians(table.place->latitude_deg),
                 here = radians(options.site->latitude_deg);
    const double east = radians(table.place->longitude_deg - options.site->longitude_deg);
    constexpr double earth_km = 6371.0;
    const double half = std::pow(std::sin(0.5 * (north - here)), 2) +
                        std::cos(north) * std::cos(here) * std::pow(std::sin(0.5 * east), 2);
    const double km = 2.0 * earth_km * std::asin(std::min(1.0, std::sqrt(half)));
    if (km > far_km) {
        table.notes.push_back(fmt::format("the station is {:.0f} km away, at {:.3f} N {:.3f} E", km,
                                          table.place->latitude_deg, table.place->longitude_deg));
    }
    const double up = table.place->height - options.elevation;
    const bool told = options.height || options.at_station;  // whoever asks goes by the height
    if (std::abs(up) > far_up_m && !told) {
        table.notes.push_back(fmt::format("the station lies {:.0f} m {}", std::abs(up),
                                          up > 0.0 ? "higher" : "lower"));
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
        for (const auto& [unit, pascal] : {std::pair{"hPa", 100.0}, {"kPa", 1000.0}}) {
            if (std::abs(all[row] * pascal - usual) > 2.0 * near * usual) continue;
            hint = fmt::format(
                "looks like {}: pressure_Pa is in Pa; [weather.columns] takes a "
                "column as \"pressure {}\"",
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

WeatherFormat weather_format(const std::filesystem::path& file) {
    const std::string head = head_of(file);
    const WeatherFormat found = format_of_content(head);
    const std::string extension = file.extension().string();
    const auto refuse = [&](const char* what) {
        throw InputError(file.string(), fmt::format("is named {} but is {}", extension, what));
    };
    if (head.empty()) return found;
    if (head.starts_with("PK\x03\x04")) {
        throw InputError(file.string(), "is a spreadsheet or another archive",
                         "save it as CSV with commas between cells");
    }
    if (extension == ".epw" && found != WeatherFormat::epw) {
        refuse("no EPW file: those begin with LOCATION");
    }
    if (extension == ".nc" && found != WeatherFormat::era5_netcdf) refuse("no netCDF file");
    if (extension == ".dat" && found == WeatherFormat::csv && head.find(',') == std::string::npos) {
        refuse("neither SURFRAD's nor BSRN's");
    }
    return found;
}

WeatherTable read_weather_table(const std::filesystem::path& file, const WeatherOptions& options) {
    const WeatherFormat format = weather_format(file);
    if (format != WeatherFormat::csv && format != WeatherFormat::era5_csv &&
        !options.columns.empty()) {
        throw InputError(file.string(),
                         "is of a format that has its own columns; those of [weather.columns] are "
                         "declared of CSV only");
    }
    switch (format) {
        case WeatherFormat::epw:
            return read_epw(file, options.asked);
        case WeatherFormat::tmy3:
            return read_tmy3(file, options.asked);
        case WeatherFormat::surfrad:
            return read_surfrad(file);
        case WeatherFormat::bsrn:
            return read_bsrn(file);
        case WeatherFormat::era5_netcdf:
            return read_era5_netcdf(file);
        case WeatherFormat::era5_csv:
            if (options.columns.empty()) return read_era5_csv(file);
            [[fallthrough]];
        case WeatherFormat::csv:
            break;
    }
    return read_own_csv(file, options.columns);
}

Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options) {
    WeatherTable table = read_weather_table(file, options);
    const Stamp stamps = stamps_of(table, options);
    table.wind_height = options.wind_height.value_or(table.wind_height);
    table.air_height = options.air_height.value_or(table.air_height);
    check_cover(table, stamps, options.asked);
    tell_place(table, options);
    fill_gaps(table, options.on_gap, options.asked, options.site);
    const bool carried = options.at_station && table.place && std::isfinite(table.place->height);
    const double height =
        options.height.value_or(carried ? table.place->height : options.elevation);
    check_pressure(table, height);
    Weather weather = weather_series(table, stamps, height);
    weather.height = height;
    change_weather(weather, options.change, options.where_changed);
    return weather;
}

}  // namespace diurna
