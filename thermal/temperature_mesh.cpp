#include "thermal/temperature_mesh.hpp"

#include <fmt/format.h>
#include <netcdf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "thermal/netcdf_output.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_facets = std::size_t{1} << 28;

class MeshReader {
 public:
    MeshReader(const NetcdfFile& file, const fs::path& path) : id_(file.id()), path_(path) {}

    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError(path_.string(), problem);
    }
    void must(int status, const std::string& what) const {
        if (status != NC_NOERR) fail(fmt::format("has no {} of a temperature field", what));
    }
    std::size_t length(const char* name) const {
        int dim = 0;
        std::size_t length = 0;
        must(nc_inq_dimid(id_, name, &dim), fmt::format("dimension '{}'", name));
        must(nc_inq_dimlen(id_, dim, &length), fmt::format("dimension '{}'", name));
        if (length == 0 || length > most_facets) fail(fmt::format("has {} of '{}'", length, name));
        return length;
    }
    /// A variable of these dimensions.
    int variable(const char* name, const std::vector<const char*>& dims) const {
        int found = 0, rank = 0, shape[NC_MAX_VAR_DIMS];
        must(nc_inq_varid(id_, name, &found), fmt::format("variable '{}'", name));
        must(nc_inq_varndims(id_, found, &rank), fmt::format("shape of '{}'", name));
        bool good = rank == int(dims.size()) && nc_inq_vardimid(id_, found, shape) == NC_NOERR;
        for (std::size_t k = 0; good && k < dims.size(); ++k) {
            int dim = 0;
            good = nc_inq_dimid(id_, dims[k], &dim) == NC_NOERR && dim == shape[k];
        }
        if (!good) fail(fmt::format("{} does not have the shape of a temperature field", name));
        return found;
    }
    bool has(const char* name) const {
        int found = 0;
        return nc_inq_varid(id_, name, &found) == NC_NOERR;
    }
    std::vector<int> integers(const char* name, const std::vector<const char*>& dims,
                              std::size_t count) const {
        std::vector<int> values(count);
        must(nc_get_var_int(id_, variable(name, dims), values.data()),
             fmt::format("readable '{}'", name));
        return values;
    }
    std::vector<float> floats(const char* name, std::size_t count) const {
        std::vector<float> values(count);
        must(nc_get_var_float(id_, variable(name, {"vertex"}), values.data()),
             fmt::format("readable '{}'", name));
        return values;
    }
    double attribute(const char* name) const {
        double value = 0.0;
        std::size_t count = 0;
        must(nc_inq_attlen(id_, NC_GLOBAL, name, &count), fmt::format("attribute '{}'", name));
        if (count != 1) fail(fmt::format("{} is not a single number", name));
        must(nc_get_att_double(id_, NC_GLOBAL, name, &value), fmt::format("attribute '{}'", name));
        return value;
    }
    /// Names that an attribute could not hold (thermal/temperature_names.hpp).
    std::vector<std::string> long_names(const std::string& names) const {
        const int of = variable(names.c_str(), {names.c_str()});
        std::vector<char*> text(length(names.c_str()));
        must(nc_get_var_string(id_, of, text.data()), fmt::format("readable '{}'", names));
        std::vector<std::string> all;
        for (const char* one : text) all.emplace_back(one == nullptr ? "" : one);
        nc_free_string(text.size(), text.data());
        return all;
    }
    /// The words of flag_meanings, or of the variable in its place.
    std::vector<std::string> meanings(const char* name) const {
        const int of = variable(name, {"facet"});
        const std::string elsewhere = std::string(name) + "_name";
        if (has(elsewhere.c_str())) return long_names(elsewhere);
        std::size_t length = 0;
        must(nc_inq_attlen(id_, of, "flag_meanings", &length), fmt::format("names of '{}'", name));
        if (length > 100'000'000) fail(fmt::format("has too many names of '{}'", name));
        std::string text(length, ' ');
        must(nc_get_att_text(id_, of, "flag_meanings", text.data()),
             fmt::format("names of '{}'", name));
        std::istringstream words(text);
        std::vector<std::string> all;
        for (std::string word; words >> word;) all.push_back(word);
        return all;
    }
    /// Of a number for each facet and the names of the numbers.
    std::vector<int> flags(const char* name, std::size_t facets,
                           std::vector<std::string>& names) const {
        if (!has(name)) return std::vector<int>(facets, 0);
        names = meanings(name);
        std::vector<int> number = integers(name, {"facet"}, facets);
        for (const int n : number) {
            if (n < 0 || std::size_t(n) >= names.size() || n > 0xFFFF) {
                fail(fmt::format("{} has the value {}, which has no name", name, n));
            }
        }
        return number;
    }
    /// From the first of the local times.
    double utc_offset() const {
        if (!has("local_time")) return 0.0;
        const int clock = variable("local_time", {"time"});
        char* text = nullptr;
        const std::size_t first = 0;
        must(nc_get_var1_string(id_, clock, &first, &text), "readable local times");
        const std::string local = text == nullptr ? "" : text;
        nc_free_string(1, &text);
        int hours = 0, minutes = 0;
        char sign = '+';
        const std::size_t begin = local.size() < 6 ? 0 : local.size() - 6;
        if (local.ends_with('Z')) return 0.0;
        if (std::sscanf(local.c_str() + begin, "%c%2d:%2d", &sign, &hours, &minutes) != 3 ||
            (sign != '+' && sign != '-')) {
            fail("its local times have no UTC offset");
        }
        return (sign == '-' ? -1.0 : 1.0) * (3600.0 * hours + 60.0 * minutes);
    }

 private:
    int id_;
    const fs::path& path_;
};

void measure(FacetSet& facets) {
    for (const auto& [a, b, c] : facets.corner) {
        const Eigen::Vector3d p = facets.vertex[a].cast<double>();
        const Eigen::Vector3d q = facets.vertex[b].cast<double>();
        const Eigen::Vector3d r = facets.vertex[c].cast<double>();
        const Eigen::Vector3d across = (q - p).cross(r - p);
        facets.area.push_back(static_cast<float>(0.5 * across.norm()));
        facets.normal.push_back(across.normalized().cast<float>());
        facets.centroid.push_back(((p + q + r) / 3.0).cast<float>());
    }
}

}  // namespace

TemperatureMesh load_temperature_mesh(const fs::path& path) {
    if (!fs::is_regular_file(path)) throw InputError(path.string(), "no such file");
    int id = -1;
    note_file_read(path);
    check_values_are_its_own(path);
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id); status != NC_NOERR) {
        throw InputError(path.string(),
                         fmt::format("is not a netCDF file ({})", nc_strerror(status)));
    }
    const NetcdfFile file(path, id);
    const MeshReader in(file, path);
    const std::size_t facets = in.length("facet"), vertices = in.length("vertex");
    if (in.length("corner") != 3) in.fail("its facets are not triangles");
    // What is stored compressed is at least a thousandth.
    if (double(facets + vertices) * 12.0 > 2e3 * double(fs::file_size(path))) {
        in.fail("declares more facets than a file of this size can contain");
    }
    TemperatureMesh mesh;
    mesh.site.latitude_deg = in.attribute("site_latitude_deg");
    mesh.site.longitude_deg = in.attribute("site_longitude_deg");
    mesh.site.height = in.attribute("site_height_m");
    check_within(path.string() + ": site_latitude_deg", mesh.site.latitude_deg, -90.0, 90.0);
    check_within(path.string() + ": site_longitude_deg", mesh.site.longitude_deg, -180.0, 180.0);
    check_within(path.string() + ": site_height_m", mesh.site.height, -12e3, 100e3);
    mesh.utc_offset = in.utc_offset();
    const std::vector<float> east = in.floats("east", vertices),
                             north = in.floats("north", vertices), up = in.floats("up", vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.facets.vertex.emplace_back(east[v], north[v], up[v]);
        if (!mesh.facets.vertex.back().allFinite()) in.fail("has a place that is not finite");
    }
    const std::vector<int> corner = in.integers("corner_of_facet", {"facet", "corner"}, 3 * facets);
    for (const int v : corner) {
        if (v < 0 || std::size_t(v) >= vertices) in.fail("has a corner that is not a vertex");
    }
    for (std::size_t f = 0; f < facets; ++f) {
        mesh.facets.corner.push_back({std::uint32_t(corner[3 * f]),
                                      std::uint32_t(corner[3 * f + 1]),
                                      std::uint32_t(corner[3 * f + 2])});
    }
    for (const int n : in.flags("material", facets, mesh.materials)) {
        mesh.facets.material.push_back(MaterialId(n));
    }
    for (const int n : in.flags("object", facets, mesh.objects)) {
        mesh.facets.object.push_back(ObjectId(n));
    }
    measure(mesh.facets);
    return mesh;
}

namespace {

/// A global attribute of at most so many bytes; "" where there is none.
std::string global_text(const fs::path& path, const char* name, std::size_t most) {
    int id = -1;
    std::size_t length = 0;
    note_file_read(path);
    check_values_are_its_own(path);
    if (!fs::is_regular_file(path) || nc_open(path.c_str(), NC_NOWRITE, &id) != NC_NOERR) return "";
    const NetcdfFile file(path, id);
    if (nc_inq_attlen(id, NC_GLOBAL, name, &length) != NC_NOERR || length > most) return "";
    std::string text(length, ' ');
    return nc_get_att_text(id, NC_GLOBAL, name, text.data()) == NC_NOERR ? text : "";
}

}  // namespace

std::string netcdf_title(const fs::path& path) { return global_text(path, "title", 1000); }

std::string temperatures_made_of(const fs::path& path) {
    return global_text(path, made_of_name, 10'000'000);
}

}  // namespace diurna
