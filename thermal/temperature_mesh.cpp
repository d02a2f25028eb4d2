#include "thermal/temperature_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "materials/base/error.hpp"
#include "thermal/netcdf/netcdf_reader.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_facets = std::size_t{1} << 28;

std::size_t length_of(const NetcdfReader& file, const char* dimension) {
    const std::size_t length = file.length(dimension);
    if (length == 0 || length > most_facets) {
        throw file.refused(fmt::format("has {} of '{}'", length, dimension));
    }
    return length;
}

double site_number(const NetcdfReader& file, const char* name) {
    const std::optional<double> value = file.number("", name);
    if (!value) throw file.without(fmt::format("attribute '{}' with a single number", name));
    return *value;
}

std::vector<float> coordinates(const NetcdfReader& file, const char* name) {
    file.check_dimensions(name, {"vertex"});
    return file.values<float>(name);
}

/// The words of flag_meanings, or of the variable in its place (thermal/temperature_names.hpp).
std::vector<std::string> meanings(const NetcdfReader& file, const std::string& name) {
    const std::string elsewhere = name + "_name";
    if (file.has(elsewhere)) {
        file.check_dimensions(elsewhere, {elsewhere});
        return file.strings(elsewhere);
    }
    const std::optional<std::string> text = file.text(name, "flag_meanings");
    if (!text) throw file.without(fmt::format("names of '{}'", name));
    std::istringstream words(*text);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    return all;
}

/// Of a number for each facet and the names of the numbers.
std::vector<int> flags(const NetcdfReader& file, const char* name, std::size_t facets,
                       std::vector<std::string>& names) {
    if (!file.has(name)) return std::vector<int>(facets, 0);
    file.check_dimensions(name, {"facet"});
    names = meanings(file, name);
    std::vector<int> number = file.values<int>(name);
    for (const int n : number) {
        if (n < 0 || std::size_t(n) >= names.size() || n > 0xFFFF) {
            throw file.refused(fmt::format("{} has the value {}, which has no name", name, n));
        }
    }
    return number;
}

/// From the first of the local times.
double utc_offset_of(const NetcdfReader& file) {
    if (!file.has("local_time")) return 0.0;
    file.check_dimensions("local_time", {"time"});
    const std::vector<std::string> clock = file.strings("local_time");
    const std::string local = clock.empty() ? "" : clock.front();
    if (local.ends_with('Z')) return 0.0;
    int hours = 0, minutes = 0;
    char sign = '+';
    const std::size_t begin = local.size() < 6 ? 0 : local.size() - 6;
    if (std::sscanf(local.c_str() + begin, "%c%2d:%2d", &sign, &hours, &minutes) != 3 ||
        (sign != '+' && sign != '-')) {
        throw file.refused("its local times have no UTC offset");
    }
    return (sign == '-' ? -1.0 : 1.0) * (3600.0 * hours + 60.0 * minutes);
}

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
    const NetcdfReader file(path, "a temperature field");
    const std::size_t facets = length_of(file, "facet");
    length_of(file, "vertex");
    if (length_of(file, "corner") != 3) throw file.refused("its facets are not triangles");
    TemperatureMesh mesh;
    mesh.site.latitude_deg = site_number(file, "site_latitude_deg");
    mesh.site.longitude_deg = site_number(file, "site_longitude_deg");
    mesh.site.height = site_number(file, "site_height_m");
    check_within(path.string() + ": site_latitude_deg", mesh.site.latitude_deg, -90.0, 90.0);
    check_within(path.string() + ": site_longitude_deg", mesh.site.longitude_deg, -180.0, 180.0);
    check_within(path.string() + ": site_height_m", mesh.site.height, -12e3, 100e3);
    mesh.utc_offset = utc_offset_of(file);
    const std::vector<float> east = coordinates(file, "east"), north = coordinates(file, "north"),
                             up = coordinates(file, "up");
    for (std::size_t v = 0; v < east.size(); ++v) {
        mesh.facets.vertex.emplace_back(east[v], north[v], up[v]);
        if (!mesh.facets.vertex.back().allFinite()) {
            throw file.refused("has a place that is not finite");
        }
    }
    file.check_dimensions("corner_of_facet", {"facet", "corner"});
    const std::vector<int> corner = file.values<int>("corner_of_facet");
    for (const int v : corner) {
        if (v < 0 || std::size_t(v) >= east.size()) {
            throw file.refused("has a corner that is not a vertex");
        }
    }
    for (std::size_t f = 0; f < facets; ++f) {
        mesh.facets.corner.push_back({std::uint32_t(corner[3 * f]),
                                      std::uint32_t(corner[3 * f + 1]),
                                      std::uint32_t(corner[3 * f + 2])});
    }
    for (const int n : flags(file, "material", facets, mesh.materials)) {
        mesh.facets.material.push_back(MaterialId(n));
    }
    for (const int n : flags(file, "object", facets, mesh.objects)) {
        mesh.facets.object.push_back(ObjectId(n));
    }
    measure(mesh.facets);
    return mesh;
}

namespace {

/// A text of the file; "" where there is none, or no netCDF file.
std::string file_text(const fs::path& path, const char* name) {
    try {
        return NetcdfReader(path, "").text("", name).value_or("");
    } catch (const InputError&) {
        return "";
    }
}

}  // namespace

std::string netcdf_title(const fs::path& path) { return file_text(path, "title"); }

std::string temperatures_made_of(const fs::path& path) { return file_text(path, made_of_name); }

}  // namespace diurna
