#include "thermal/weather_file/era5_netcdf.hpp"

#include <fmt/format.h>
#include <netcdf.h>

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
    ~NetcdfFile() { nc_close(id_); }
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    /// The id of a variable, or −1.
    int variable(const std::string& name) const {
        int id = -1;
        return nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR ? id : -1;
    }
    /// All its values, unpacked; NaN where filled. Of `count` of them, else InputError.
    std::vector<double> values(const std::string& name, std::size_t count) const {
        const int id = variable(name);
        if (const std::size_t found = size_of(id); found != count) {
            throw InputError(path_ + ": " + name,
                             fmt::format("holds {} values for {} instants", found, count),
                             "extract one point");
        }
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
    std::size_t size_of(int variable) const {
        int dimensions = 0;
        check(nc_inq_varndims(id_, variable, &dimensions), "cannot be read");
        std::vector<int> ids(std::size_t(dimensions), 0);
        check(nc_inq_vardimid(id_, variable, ids.data()), "cannot be read");
        std::size_t size = 1;
        for (const int dimension : ids) {
            std::size_t length = 0;
            check(nc_inq_dimlen(id_, dimension, &length), "cannot be read");
            size *= length;
        }
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

}  // namespace

WeatherTable read_era5_netcdf(const std::filesystem::path& file) {
    const NetcdfFile netcdf(file);
    const std::string time = netcdf.variable("valid_time") >= 0 ? "valid_time" : "time";
    const std::string where = file.string() + ": " + time;
    if (netcdf.variable(time) < 0) {
        throw InputError(file.string(), "neither valid_time nor time in it");
    }
    WeatherTable table{.file = file, .format = "ERA5 netCDF"};
    const auto [start, step] = time_units(netcdf.text(netcdf.variable(time), "units"), where);
    const std::size_t count = netcdf.size_of(netcdf.variable(time));
    if (count == 0) throw InputError(where, "holds no instants");
    for (const double value : netcdf.values(time, count)) {
        add_row(table, later(start, value * step),
                fmt::format("{}[{}]", where, table.stamp.size()));
    }
    Era5Values values;
    for (const std::string& name : era5_names()) {
        if (netcdf.variable(name) >= 0) values[name] = netcdf.values(name, count);
    }
    put_era5(values, table);
    if (netcdf.variable("latitude") >= 0 && netcdf.variable("longitude") >= 0) {
        double east = netcdf.values("longitude", 1).front();
        if (east > 180.0) east -= 360.0;
        table.place = {netcdf.values("latitude", 1).front(), east, not_measured};
    }
    return table;
}

}  // namespace diurna
