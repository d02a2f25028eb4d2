#include "thermal/weather_file/era5_netcdf.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <cmath>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "thermal/weather_file/era5.hpp"
#include "thermal/weather_file/stamps.hpp"

namespace diurna {

namespace {

/// A netCDF file open for reading.
class NetcdfFile {
 public:
    explicit NetcdfFile(const std::filesystem::path& file) : path_(file.string()) {
        note_file_read(file);
        check_values_are_its_own(file);
        check(nc_open(path_.c_str(), NC_NOWRITE, &id_), "cannot be opened");
    }
    /// One in memory, named by `file`.
    NetcdfFile(const std::filesystem::path& file, std::span<const std::byte> bytes)
        : path_(file.string()) {
        check_values_are_its_own(bytes, path_);
        // The library only reads what it takes for writable.
        check(nc_open_mem(path_.c_str(), NC_NOWRITE, bytes.size(),
                          const_cast<std::byte*>(bytes.data()), &id_),
              "cannot be opened");
    }
    ~NetcdfFile() { nc_close(id_); }
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    /// The id of a variable, or −1.
    int variable(const std::string& name) const {
        int id = -1;
        return nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR ? id : -1;
    }
    /// The values of a variable at each of `count` instants, unpacked; NaN where filled. Along
    /// expver, which has the final and the preliminary value, the first that is there counts.
    /// Throws InputError for other dimensions longer than one.
    std::vector<double> values(const std::string& name, std::size_t count) const {
        const int id = variable(name);
        std::size_t versions = 1, size = 1, apart = 1, version_apart = 1;
        const std::vector<Dimension> dimensions = dimensions_of(id);
        for (auto d = dimensions.rbegin(); d != dimensions.rend(); ++d) {
            if (d->name == "expver") {
                versions = d->length;
                version_apart = size;
            } else if (d->length == count && (d->name == "time" || d->name == "valid_time")) {
                apart = size;
            }
            size *= d->length;
        }
        constexpr std::size_t most_versions = 100;
        if (versions == 0 || versions > most_versions || size != count * versions) {
            throw InputError(path_ + ": " + name,
                             fmt::format("holds {} values for {} instants", size, count),
                             "extract one point");
        }
        const std::vector<double> all = unpacked(id, name, size);
        std::vector<double> chosen(count, not_measured);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t v = 0; v < versions && std::isnan(chosen[i]); ++v) {
                chosen[i] = all[i * apart + v * version_apart];
            }
        }
        return chosen;
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
    std::vector<double> unpacked(int id, const std::string& name, std::size_t count) const {
        std::vector<double> raw(count);
        check(nc_get_var_double(id_, id, raw.data()), name + " cannot be read");
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

Era5Series netcdf_series_of(const NetcdfFile& netcdf, const std::filesystem::path& file) {
    const std::string time = netcdf.variable("valid_time") >= 0 ? "valid_time" : "time";
    const std::string where = file.string() + ": " + time;
    if (netcdf.variable(time) < 0) {
        throw InputError(file.string(), "neither valid_time nor time in it");
    }
    Era5Series series{.file = file, .format = "ERA5 netCDF"};
    const auto [start, step] = time_units(netcdf.text(netcdf.variable(time), "units"), where);
    const std::size_t count = netcdf.size_of(netcdf.variable(time));
    if (count == 0) throw InputError(where, "holds no instants");
    for (const double value : netcdf.values(time, count)) {
        add_stamp(series, later(start, value * step),
                  fmt::format("{}[{}]", where, series.stamp.size()));
    }
    for (const std::string& name : netcdf.variables()) {
        if (is_era5_name(name)) {
            series.values[name] = netcdf.values(name, count);
        } else if (name != time) {
            series.unused.push_back(name);
        }
    }
    if (netcdf.variable("latitude") >= 0 && netcdf.variable("longitude") >= 0) {
        double east = netcdf.values("longitude", 1).front();
        if (east > 180.0) east -= 360.0;
        series.place = {netcdf.values("latitude", 1).front(), east, not_measured};
    }
    return series;
}

}  // namespace

Era5Series read_era5_netcdf(const std::filesystem::path& file) {
    return netcdf_series_of(NetcdfFile(file), file);
}

Era5Series era5_netcdf_series(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    return netcdf_series_of(NetcdfFile(file, bytes), file);
}

}  // namespace diurna
