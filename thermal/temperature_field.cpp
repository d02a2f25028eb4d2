#include "thermal/temperature_field.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

/// An open netCDF file; closed, and removed if it was not finished.
class File {
 public:
    File(fs::path path, int id) : path_(std::move(path)), id_(id) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (id_ >= 0) nc_close(id_);
        if (!temporary_.empty()) {
            std::error_code ignored;
            fs::remove(temporary_, ignored);
        }
    }
    static File create(const fs::path& target) {
        const fs::path temporary = target.string() + fmt::format(".{}.part", getpid());
        int id = -1;
        const int status = nc_create(temporary.c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
        File file(target, status == NC_NOERR ? id : -1);
        file.temporary_ = temporary;
        file.must(status);
        return file;
    }
    File(File&& other) noexcept
        : path_(std::move(other.path_)),
          temporary_(std::exchange(other.temporary_, {})),
          id_(std::exchange(other.id_, -1)) {}

    void must(int status) const {
        if (status != NC_NOERR) {
            throw std::runtime_error(
                fmt::format("{}: cannot be written: {}", path_.string(), nc_strerror(status)));
        }
    }
    int id() const { return id_; }
    int dimension(const char* name, std::size_t length) const {
        int dim;
        must(nc_def_dim(id_, name, length, &dim));
        return dim;
    }
    int variable(const char* name, nc_type type, const std::vector<int>& dims) const {
        int variable;
        must(nc_def_var(id_, name, type, int(dims.size()), dims.data(), &variable));
        if (dims.size() == 2) must(nc_def_var_deflate(id_, variable, 1, 1, 1));
        return variable;
    }
    void text(int variable, const char* name, const std::string& value) const {
        must(nc_put_att_text(id_, variable, name, value.size(), value.c_str()));
    }
    void finish() {
        must(nc_close(std::exchange(id_, -1)));
        std::error_code error;
        fs::rename(temporary_, path_, error);
        if (error) {
            throw std::runtime_error(
                fmt::format("{}: cannot be written: {}", path_.string(), error.message()));
        }
        temporary_.clear();
    }

 private:
    fs::path path_, temporary_;
    int id_;
};

/// What a temperature field's file holds.
struct Variables {
    int corner, time, kelvin;
    std::array<int, 3> axis;  // east, north, up
};

/// Dimensions, variables and their attributes: what a reader learns before any number.
Variables declare(const File& file, const TemperatureField& field, const FacetSet& facets,
                  const Site& site) {
    const int time_dim = file.dimension("time", field.instant.size());
    const int facet_dim = file.dimension("facet", field.facets);
    const int vertex_dim = file.dimension("vertex", facets.vertex.size());
    const int three = file.dimension("corner", 3);

    file.text(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
    file.text(NC_GLOBAL, "title", "diurna facet temperatures");
    for (const auto& [name, value] : {std::pair{"site_latitude_deg", site.latitude_deg},
                                      std::pair{"site_longitude_deg", site.longitude_deg},
                                      std::pair{"site_height_m", site.height}}) {
        file.must(nc_put_att_double(file.id(), NC_GLOBAL, name, NC_DOUBLE, 1, &value));
    }

    const int mesh = file.variable("mesh", NC_INT, {});
    const int dimension = 2;
    file.text(mesh, "cf_role", "mesh_topology");
    file.must(nc_put_att_int(file.id(), mesh, "topology_dimension", NC_INT, 1, &dimension));
    file.text(mesh, "node_coordinates", "east north up");
    file.text(mesh, "face_node_connectivity", "corner_of_facet");
    file.text(mesh, "face_dimension", "facet");

    Variables variables{};
    variables.corner = file.variable("corner_of_facet", NC_INT, {facet_dim, three});
    const int zero = 0;
    file.text(variables.corner, "cf_role", "face_node_connectivity");
    file.must(nc_put_att_int(file.id(), variables.corner, "start_index", NC_INT, 1, &zero));
    const std::array<const char*, 3> names{"east", "north", "up"};
    for (std::size_t i = 0; i < 3; ++i) {
        variables.axis[i] = file.variable(names[i], NC_FLOAT, {vertex_dim});
        file.text(variables.axis[i], "units", "m");
        file.text(variables.axis[i], "long_name", std::string(names[i]) + " of the site's origin");
    }
    variables.time = file.variable("time", NC_DOUBLE, {time_dim});
    file.text(variables.time, "standard_name", "time");
    file.text(variables.time, "units", "seconds since 1970-01-01T00:00:00Z");
    file.text(variables.time, "calendar", "standard");
    variables.kelvin = file.variable("surface_temperature", NC_FLOAT, {time_dim, facet_dim});
    file.text(variables.kelvin, "standard_name", "surface_temperature");
    file.text(variables.kelvin, "units", "K");
    file.text(variables.kelvin, "mesh", "mesh");
    file.text(variables.kelvin, "location", "face");
    file.must(nc_enddef(file.id()));
    return variables;
}

void write_mesh(const File& file, const Variables& variables, const FacetSet& facets) {
    std::vector<int> corners;
    corners.reserve(3 * facets.size());
    for (const auto& triangle : facets.corner) {
        for (const auto v : triangle) corners.push_back(int(v));
    }
    file.must(nc_put_var_int(file.id(), variables.corner, corners.data()));
    std::vector<float> coordinate(facets.vertex.size());
    for (int i = 0; i < 3; ++i) {
        std::transform(facets.vertex.begin(), facets.vertex.end(), coordinate.begin(),
                       [i](const Eigen::Vector3f& v) { return v[i]; });
        file.must(nc_put_var_float(file.id(), variables.axis[std::size_t(i)], coordinate.data()));
    }
}

void write_temperatures(const File& file, const Variables& variables,
                        const TemperatureField& field) {
    std::vector<double> seconds;
    for (const Instant when : field.instant) seconds.push_back(seconds_between(Instant{}, when));
    file.must(nc_put_var_double(file.id(), variables.time, seconds.data()));
    file.must(nc_put_var_float(file.id(), variables.kelvin, field.kelvin.data()));
}

}  // namespace

std::vector<float> TemperatureField::interpolate(Instant when) const {
    assert(!instant.empty());
    const auto after = std::upper_bound(instant.begin(), instant.end(), when);
    const auto i = static_cast<std::size_t>(after - instant.begin());
    if (i == 0 || i == instant.size()) {
        const auto row = at(i == 0 ? 0 : i - 1);
        return {row.begin(), row.end()};
    }
    const float share =
        float(seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i]));
    const auto a = at(i - 1), b = at(i);
    std::vector<float> result(facets);
    for (std::size_t f = 0; f < facets; ++f) result[f] = a[f] + share * (b[f] - a[f]);
    return result;
}

void save_temperature_field(const fs::path& path, const TemperatureField& field,
                            const FacetSet& facets, const Site& site) {
    assert(field.facets == facets.size());
    const auto bad = std::find_if_not(field.kelvin.begin(), field.kelvin.end(),
                                      [](float kelvin) { return std::isfinite(kelvin); });
    if (bad != field.kelvin.end()) {
        throw std::runtime_error(
            fmt::format("{}: the temperature of facet {} is not finite", path.string(),
                        static_cast<std::size_t>(bad - field.kelvin.begin()) % field.facets));
    }
    File file = File::create(path);
    const Variables variables = declare(file, field, facets, site);
    write_mesh(file, variables, facets);
    write_temperatures(file, variables, field);
    file.finish();
}

TemperatureField load_temperature_field(const fs::path& path) {
    const auto fail = [&](const std::string& problem) -> InputError {
        return InputError(path.string(), problem);
    };
    if (!fs::is_regular_file(path)) throw fail("no such file");
    int id = -1;
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id); status != NC_NOERR) {
        throw fail(fmt::format("is no netCDF file ({})", nc_strerror(status)));
    }
    const File file(path, id);
    const auto must = [&](int status, const char* what) {
        if (status != NC_NOERR) throw fail(fmt::format("has no {} of a temperature field", what));
    };
    int time_dim, facet_dim, time, kelvin, dims[2], rank;
    std::size_t instants, facets;
    must(nc_inq_dimid(id, "time", &time_dim), "dimension 'time'");
    must(nc_inq_dimid(id, "facet", &facet_dim), "dimension 'facet'");
    must(nc_inq_dimlen(id, time_dim, &instants), "instants");
    must(nc_inq_dimlen(id, facet_dim, &facets), "facets");
    must(nc_inq_varid(id, "time", &time), "variable 'time'");
    must(nc_inq_varid(id, "surface_temperature", &kelvin), "variable 'surface_temperature'");
    must(nc_inq_varndims(id, kelvin, &rank), "shape");
    if (rank != 2) throw fail("surface_temperature is not (time, facet)");
    must(nc_inq_vardimid(id, kelvin, dims), "shape");
    int time_rank, time_of_time;
    must(nc_inq_varndims(id, time, &time_rank), "times");
    if (time_rank != 1) throw fail("time is not (time)");
    must(nc_inq_vardimid(id, time, &time_of_time), "times");
    if (dims[0] != time_dim || dims[1] != facet_dim || time_of_time != time_dim) {
        throw fail("surface_temperature is not (time, facet)");
    }
    if (instants == 0 || facets == 0) throw fail("holds no temperatures");
    // A short header may claim any size; what is stored compressed is at least a thousandth.
    if (double(instants) * double(facets) * sizeof(float) > 2e3 * double(fs::file_size(path))) {
        throw fail("claims more temperatures than so small a file can hold");
    }

    TemperatureField field{
        .instant = {}, .facets = facets, .kelvin = std::vector<float>(instants * facets)};
    std::vector<double> seconds(instants);
    must(nc_get_var_double(id, time, seconds.data()), "readable times");
    must(nc_get_var_float(id, kelvin, field.kelvin.data()), "readable temperatures");
    for (const double s : seconds) {
        if (!std::isfinite(s) || std::abs(s) > 1e12) throw fail("holds times that are not finite");
        field.instant.push_back(later(Instant{}, s));
    }
    if (std::adjacent_find(field.instant.begin(), field.instant.end(), std::greater_equal<>()) !=
        field.instant.end()) {
        throw fail("holds times that do not ascend");
    }
    if (std::any_of(field.kelvin.begin(), field.kelvin.end(),
                    [](float t) { return !(std::isfinite(t) && t > 0.0f); })) {
        throw fail("holds temperatures that are not finite and positive");
    }
    return field;
}

}  // namespace diurna
