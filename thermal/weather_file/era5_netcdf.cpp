#include "thermal/weather_file/era5_netcdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "materials/base/error.hpp"
#include "thermal/netcdf/netcdf_reader.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/era5_units.hpp"
#include "thermal/weather_file/stamps.hpp"
#include "thermal/weather_file/station_warnings.hpp"

namespace diurna {

namespace {

/// A grid point of an area by its places along latitude and longitude.
struct GridPoint {
    std::size_t row = 0, column = 0;
};
bool is_latitude(const std::string& name) { return name == "latitude" || name == "lat"; }
bool is_longitude(const std::string& name) { return name == "longitude" || name == "lon"; }

/// Numbers as they are packed in the file, unpacked; NaN where filled.
std::vector<double> unpacked(const NetcdfReader& file, const std::string& name,
                             std::vector<double> numbers) {
    const double scale = file.number(name, "scale_factor").value_or(1.0);
    const double offset = file.number(name, "add_offset").value_or(0.0);
    const double fill = file.number(name, "_FillValue").value_or(not_measured);
    const double missing = file.number(name, "missing_value").value_or(not_measured);
    for (double& value : numbers) {
        value = value == fill || value == missing ? not_measured : scale * value + offset;
    }
    return numbers;
}

/// The values of a variable at each of `count` instants. Along expver, which has the final and the
/// preliminary value, the first that is there counts. Of an area the values at its grid point `at`.
/// Throws InputError for other dimensions longer than one.
std::vector<double> values_of(const NetcdfReader& file, const std::string& name, std::size_t count,
                              const GridPoint& at = {}) {
    const std::vector<NetcdfReader::Dimension> dimensions = file.dimensions(name);
    std::size_t versions = 1, size = 1, apart = 1, version_apart = 1;
    std::vector<std::size_t> first(dimensions.size(), 0), length(dimensions.size(), 1);
    for (std::size_t d = dimensions.size(); d-- > 0;) {
        const NetcdfReader::Dimension& one = dimensions[d];
        length[d] = one.length;
        if (one.name == "expver") {
            versions = one.length;
            version_apart = size;
        } else if (one.length == count && (one.name == "time" || one.name == "valid_time")) {
            apart = size;
        } else if (is_latitude(one.name) && at.row < one.length) {
            first[d] = at.row;
            length[d] = 1;
        } else if (is_longitude(one.name) && at.column < one.length) {
            first[d] = at.column;
            length[d] = 1;
        }
        size *= length[d];
    }
    constexpr std::size_t most_versions = 100;
    if (versions == 0 || versions > most_versions || size != count * versions) {
        throw InputError(fmt::format("{}: {}", file.path().string(), name),
                         fmt::format("has {} values for {} instants", size, count),
                         "expected dimensions of time, latitude and longitude, and expver");
    }
    const std::vector<double> all = unpacked(file, name, file.values<double>(name, first, length));
    std::vector<double> chosen(count, not_measured);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t v = 0; v < versions && std::isnan(chosen[i]); ++v) {
            chosen[i] = all[i * apart + v * version_apart];
        }
    }
    return chosen;
}

/// Values of a variable in the unit of its short name, by its attribute `units`.
std::vector<double> in_era5_unit(const NetcdfReader& file, const std::string& name,
                                 const std::string& variable, std::vector<double> values) {
    const std::string units = file.text(variable, "units").value_or("");
    const Era5Unit unit =
        era5_unit(name, variable, units, fmt::format("{}: {}", file.path().string(), variable));
    for (double& value : values) value = unit.factor * value + unit.offset;
    return values;
}

/// All values of a variable of one dimension, such as those of latitude.
std::vector<double> axis_of(const NetcdfReader& file, const std::string& name) {
    if (!file.has(name) || file.dimensions(name).size() > 1) return {};
    return unpacked(file, name, file.values<double>(name));
}

/// Parts of a date or clock with two digits: "2023-7-1" as "2023-07-01".
std::string padded(const std::string& text, char between) {
    std::string all, part;
    std::istringstream parts(text);
    while (std::getline(parts, part, between)) {
        const bool single = part.find_first_not_of("0123456789") == 1 || part.size() == 1;
        all += (all.empty() ? "" : std::string(1, between)) + (single ? "0" : "") + part;
    }
    return all;
}

/// The start and the step [s] of "hours since 1900-01-01 00:00:00.0".
std::pair<Instant, double> time_units(const std::string& units, const std::string& where) {
    std::istringstream words(units);
    std::string step, since, date, clock;
    words >> step >> since >> date >> clock;
    double seconds = 0.0;
    if (step.starts_with("second")) seconds = 1.0;
    if (step.starts_with("minute")) seconds = 60.0;
    if (step.starts_with("hour")) seconds = 3600.0;
    if (step.starts_with("day")) seconds = 86400.0;
    if (seconds == 0.0 || since != "since" || date.empty()) {
        throw InputError(where, fmt::format("found units '{}', expected 'hours since ...'", units));
    }
    if (clock.empty()) clock = "00:00:00";
    return {stamp_in(padded(date, '-') + "T" + padded(clock, ':'), 0.0, where), seconds};
}

double east_of(double longitude_deg) {
    return longitude_deg > 180.0 ? longitude_deg - 360.0 : longitude_deg;
}

/// The point of an area nearest to the site that has values, its place put into the series.
GridPoint point_of_area(const NetcdfReader& netcdf, std::size_t instants,
                        const std::optional<Geodetic>& site, Era5Series& series) {
    const std::vector<double> north = axis_of(netcdf, netcdf.has("latitude") ? "latitude" : "lat");
    const std::vector<double> east = axis_of(netcdf, netcdf.has("longitude") ? "longitude" : "lon");
    if (north.empty() || east.empty()) return {};
    const auto place_of = [&](const GridPoint& point) {
        return Geodetic{north[point.row], east_of(east[point.column]), 0.0};
    };
    const Geodetic near = site.value_or(Geodetic{0.5 * (north.front() + north.back()),
                                                 east_of(0.5 * (east.front() + east.back())), 0.0});
    std::vector<GridPoint> points;
    for (std::size_t row = 0; row < north.size(); ++row) {
        for (std::size_t column = 0; column < east.size(); ++column)
            points.push_back({row, column});
    }
    constexpr std::size_t most_tried = 9;
    const std::size_t tried = std::min(most_tried, points.size());
    std::partial_sort(points.begin(), points.begin() + std::ptrdiff_t(tried), points.end(),
                      [&](const GridPoint& a, const GridPoint& b) {
                          return distance_km(place_of(a), near) < distance_km(place_of(b), near);
                      });
    GridPoint chosen = points.front();
    const std::vector<std::string> names = netcdf.variables();
    const auto known = std::find_if(names.begin(), names.end(), [](const std::string& name) {
        return !era5_name_of(name).empty();
    });
    for (std::size_t k = 0; k < tried && points.size() > 1 && known != names.end(); ++k) {
        const std::vector<double> values = values_of(netcdf, *known, instants, points[k]);
        if (std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) {
            continue;
        }
        chosen = points[k];
        break;
    }
    series.place = place_of(chosen);
    series.place->height = not_measured;
    if (points.size() > 1) {
        series.notes.push_back(fmt::format(
            "the file covers {} x {} grid points: the one at {:.2f} N {:.2f} E is used, {}",
            north.size(), east.size(), series.place->latitude_deg, series.place->longitude_deg,
            site ? fmt::format("{:.0f} km from the site", distance_km(place_of(chosen), near))
                 : "nearest to the centre; in a scene the one nearest to the site is used"));
    }
    return chosen;
}

Era5Series netcdf_series_of(const NetcdfReader& netcdf, const std::filesystem::path& file,
                            const std::optional<Geodetic>& site) {
    const std::string time = netcdf.has("valid_time") ? "valid_time" : "time";
    const std::string where = file.string() + ": " + time;
    if (!netcdf.has(time)) {
        throw InputError(file.string(), "has neither valid_time nor time");
    }
    Era5Series series{.file = file, .format = "ERA5 netCDF"};
    const auto [start, step] = time_units(netcdf.text(time, "units").value_or(""), where);
    const std::size_t count = netcdf.size(time);
    if (count == 0) throw InputError(where, "has no instants");
    for (const double value : values_of(netcdf, time, count)) {
        add_stamp(series, later(start, value * step),
                  fmt::format("{}[{}]", where, series.stamp.size()));
    }
    const GridPoint point = point_of_area(netcdf, count, site, series);
    for (const std::string& variable : netcdf.variables()) {
        const std::string name = era5_name_of(variable);
        if (!name.empty() && !series.values.contains(name)) {
            series.values[name] =
                in_era5_unit(netcdf, name, variable, values_of(netcdf, variable, count, point));
        } else if (variable != time) {
            series.unused.push_back(variable);
        }
    }
    return series;
}

}  // namespace

Era5Series read_era5_netcdf(const std::filesystem::path& file,
                            const std::optional<Geodetic>& site) {
    return netcdf_series_of(NetcdfReader(file, "ERA5 in netCDF"), file, site);
}

Era5Series era5_netcdf_series(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const std::optional<Geodetic>& site) {
    return netcdf_series_of(NetcdfReader(file, bytes, "ERA5 in netCDF"), file, site);
}

}  // namespace diurna
