#include "thermal/weather_file/era5_netcdf.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "thermal/weather_file/era5.hpp"
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

/// A netCDF file open for reading.
class Era5Netcdf {
 public:
    explicit Era5Netcdf(const std::filesystem::path& file) : path_(file.string()) {
        note_file_read(file);
        check_values_are_its_own(file);
        check(nc_open(path_.c_str(), NC_NOWRITE, &id_), "cannot be opened");
    }
    /// One in memory, named by `file`.
    Era5Netcdf(const std::filesystem::path& file, std::span<const std::byte> bytes)
        : path_(file.string()) {
        check_values_are_its_own(bytes, path_);
        // The library only reads what it takes for writable.
        check(nc_open_mem(path_.c_str(), NC_NOWRITE, bytes.size(),
                          const_cast<std::byte*>(bytes.data()), &id_),
              "cannot be opened");
    }
    ~Era5Netcdf() { nc_close(id_); }
    Era5Netcdf(const Era5Netcdf&) = delete;
    Era5Netcdf& operator=(const Era5Netcdf&) = delete;

    /// The id of a variable, or −1.
    int variable(const std::string& name) const {
        int id = -1;
        return nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR ? id : -1;
    }
    /// The values of a variable at each of `count` instants, unpacked; NaN where filled. Along
    /// expver, which has the final and the preliminary value, the first that is there counts.
    /// Of an area the values at its grid point `at`. Throws InputError for other dimensions longer
    /// than one.
    std::vector<double> values(const std::string& name, std::size_t count,
                               const GridPoint& at = {}) const {
        const int id = variable(name);
        std::size_t versions = 1, size = 1, apart = 1, version_apart = 1;
        const std::vector<Dimension> dimensions = dimensions_of(id);
        std::vector<std::size_t> first(dimensions.size(), 0), length(dimensions.size(), 1);
        for (std::size_t d = dimensions.size(); d-- > 0;) {
            const Dimension& one = dimensions[d];
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
            throw InputError(path_ + ": " + name,
                             fmt::format("has {} values for {} instants", size, count),
                             "expected dimensions of time, latitude and longitude, and expver");
        }
        const std::vector<double> all = unpacked(id, name, first, length, size);
        std::vector<double> chosen(count, not_measured);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t v = 0; v < versions && std::isnan(chosen[i]); ++v) {
                chosen[i] = all[i * apart + v * version_apart];
            }
        }
        return chosen;
    }
    /// All values of a variable of one dimension, such as those of latitude.
    std::vector<double> axis(const std::string& name) const {
        const int id = variable(name);
        if (id < 0 || dimensions_of(id).size() > 1) return {};
        const std::size_t size = size_of(id);
        std::vector<std::size_t> first(dimensions_of(id).size(), 0), length(first.size(), size);
        return unpacked(id, name, first, length, size);
    }
    /// The names of all variables.
    std::vector<std::string> variables() const {
        int count = 0;
        check(nc_inq_nvars(id_, &count), "cannot be read");
        std::vector<std::string> names;
        for (int id = 0; id < count; ++id) {
            char name[NC_MAX_NAME + 1] = {};
            check(nc_inq_varname(id_, id, name), "cannot be read");
            names.emplace_back(name);
        }
        return names;
    }
    std::size_t size_of(int variable) const {
        std::size_t size = 1;
        for (const Dimension& dimension : dimensions_of(variable)) size *= dimension.length;
        return size;
    }
    std::string text(int variable, const char* name) const {
        std::size_t length = 0;
        nc_type type = NC_NAT;
        if (nc_inq_att(id_, variable, name, &type, &length) != NC_NOERR || type != NC_CHAR) {
            return "";
        }
        std::string text(length, '\0');
        check(nc_get_att_text(id_, variable, name, text.data()), "cannot be read");
        return text;
    }

 private:
    struct Dimension {
        std::string name;
        std::size_t length;
    };
    std::vector<Dimension> dimensions_of(int variable) const {
        int count = 0;
        check(nc_inq_varndims(id_, variable, &count), "cannot be read");
        std::vector<int> ids(std::size_t(count), 0);
        check(nc_inq_vardimid(id_, variable, ids.data()), "cannot be read");
        std::vector<Dimension> dimensions;
        for (const int id : ids) {
            char name[NC_MAX_NAME + 1] = {};
            std::size_t length = 0;
            check(nc_inq_dim(id_, id, name, &length), "cannot be read");
            dimensions.push_back({name, length});
        }
        return dimensions;
    }
    std::vector<double> unpacked(int id, const std::string& name,
                                 const std::vector<std::size_t>& first,
                                 const std::vector<std::size_t>& length, std::size_t count) const {
        std::vector<double> raw(count);
        check(nc_get_vara_double(id_, id, first.data(), length.data(), raw.data()),
              name + " cannot be read");
        const double scale = attribute(id, "scale_factor", 1.0);
        const double offset = attribute(id, "add_offset", 0.0);
        const double fill = attribute(id, "_FillValue", not_measured);
        const double missing = attribute(id, "missing_value", not_measured);
        for (double& value : raw) {
            value = value == fill || value == missing ? not_measured : scale * value + offset;
        }
        return raw;
    }
    void check(int status, const std::string& what) const {
        if (status == NC_NOERR) return;
        throw InputError(path_, what + ": " + nc_strerror(status));
    }
    double attribute(int variable, const char* name, double otherwise) const {
        double value = otherwise;
        return nc_get_att_double(id_, variable, name, &value) == NC_NOERR ? value : otherwise;
    }

    std::string path_;
    int id_ = -1;
};

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
    return {stamp_in(date + "T" + clock, 0.0, where), seconds};
}

double east_of(double longitude_deg) {
    return longitude_deg > 180.0 ? longitude_deg - 360.0 : longitude_deg;
}

/// The point of an area nearest to the site that has values, its place put into the series.
GridPoint point_of_area(const Era5Netcdf& netcdf, std::size_t instants,
                        const std::optional<Geodetic>& site, Era5Series& series) {
    const std::vector<double> north =
        netcdf.axis(netcdf.variable("latitude") >= 0 ? "latitude" : "lat");
    const std::vector<double> east =
        netcdf.axis(netcdf.variable("longitude") >= 0 ? "longitude" : "lon");
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
    const auto known = std::find_if(names.begin(), names.end(), is_era5_name);
    for (std::size_t k = 0; k < tried && points.size() > 1 && known != names.end(); ++k) {
        const std::vector<double> values = netcdf.values(*known, instants, points[k]);
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

Era5Series netcdf_series_of(const Era5Netcdf& netcdf, const std::filesystem::path& file,
                            const std::optional<Geodetic>& site) {
    const std::string time = netcdf.variable("valid_time") >= 0 ? "valid_time" : "time";
    const std::string where = file.string() + ": " + time;
    if (netcdf.variable(time) < 0) {
        throw InputError(file.string(), "has neither valid_time nor time");
    }
    Era5Series series{.file = file, .format = "ERA5 netCDF"};
    const auto [start, step] = time_units(netcdf.text(netcdf.variable(time), "units"), where);
    const std::size_t count = netcdf.size_of(netcdf.variable(time));
    if (count == 0) throw InputError(where, "has no instants");
    for (const double value : netcdf.values(time, count)) {
        add_stamp(series, later(start, value * step),
                  fmt::format("{}[{}]", where, series.stamp.size()));
    }
    const GridPoint point = point_of_area(netcdf, count, site, series);
    for (const std::string& name : netcdf.variables()) {
        if (is_era5_name(name)) {
            series.values[name] = netcdf.values(name, count, point);
        } else if (name != time) {
            series.unused.push_back(name);
        }
    }
    return series;
}

}  // namespace

Era5Series read_era5_netcdf(const std::filesystem::path& file,
                            const std::optional<Geodetic>& site) {
    return netcdf_series_of(Era5Netcdf(file), file, site);
}

Era5Series era5_netcdf_series(const std::filesystem::path& file, std::span<const std::byte> bytes,
                              const std::optional<Geodetic>& site) {
    return netcdf_series_of(Era5Netcdf(file, bytes), file, site);
}

}  // namespace diurna
