#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "thermal/netcdf_output.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Which facets have the temperatures of others, as far as the file reports it.
std::vector<std::uint32_t> read_solved_as(const NetcdfFile& file, std::size_t facets, int facet_dim,
                                          const fs::path& path) {
    int variable = -1, rank = 0, shape = -1;
    if (nc_inq_varid(file.id(), solved_as_name, &variable) != NC_NOERR) return {};
    std::vector<int> number(facets);
    const bool good = nc_inq_varndims(file.id(), variable, &rank) == NC_NOERR && rank == 1 &&
                      nc_inq_vardimid(file.id(), variable, &shape) == NC_NOERR &&
                      shape == facet_dim &&
                      nc_get_var_int(file.id(), variable, number.data()) == NC_NOERR &&
                      std::all_of(number.begin(), number.end(),
                                  [&](int n) { return n >= 0 && std::size_t(n) < facets; });
    if (!good) throw InputError(path.string(), "solved_as does not name a facet for each facet");
    return {number.begin(), number.end()};
}

/// What lies on facets, as far as the file reports it: each 0 to 1, none where it does not.
CoveredFacets read_cover(const NetcdfFile& file, std::size_t instants, std::size_t facets,
                         const std::array<int, 2>& dims, const fs::path& path) {
    const auto fail = [&](const char* name, const char* problem) {
        return InputError(path.string(), fmt::format("{} {}", name, problem));
    };
    CoveredFacets all;
    std::vector<float> values;
    for (const CoverName& of : cover_names) {
        int variable = -1, rank = 0;
        std::array<int, NC_MAX_VAR_DIMS> shape{};
        if (nc_inq_varid(file.id(), of.name, &variable) != NC_NOERR) continue;
        if (nc_inq_varndims(file.id(), variable, &rank) != NC_NOERR || rank != 2 ||
            nc_inq_vardimid(file.id(), variable, shape.data()) != NC_NOERR || shape[0] != dims[0] ||
            shape[1] != dims[1]) {
            throw fail(of.name, "does not have the dimensions (time, facet)");
        }
        if (all.empty()) {
            all.facet.resize(facets);
            std::iota(all.facet.begin(), all.facet.end(), 0u);
            all.cover.resize(instants * facets);
            values.resize(instants * facets);
        }
        if (nc_get_var_float(file.id(), variable, values.data()) != NC_NOERR) {
            throw fail(of.name, "is not readable");
        }
        for (std::size_t n = 0; n < values.size(); ++n) {
            if (!(values[n] >= 0.0f && values[n] <= 1.0f)) {
                throw fail(of.name, "has values outside 0 to 1");
            }
            all.cover[n].*of.value = values[n];
        }
    }
    return all.kept();
}

/// Seconds since 1970 in UTC, in one of the ways in which programs that change such files put it.
bool counts_from_1970(const NetcdfFile& file, int time) {
    std::size_t length = 0;
    if (nc_inq_attlen(file.id(), time, "units", &length) != NC_NOERR || length > 100) return false;
    std::string units(length, ' ');
    if (nc_get_att_text(file.id(), time, "units", units.data()) != NC_NOERR) return false;
    const std::string_view begin = "seconds since 1970-01-01";
    if (!units.starts_with(begin)) return false;
    static constexpr std::array<std::string_view, 8> ends{
        "",          "T00:00:00Z", " 00:00:00",       " 00:00:00Z",
        "T00:00:00", " 00:00:0.0", " 00:00:00+00:00", " 00:00:00 UTC"};
    return std::find(ends.begin(), ends.end(), std::string_view(units).substr(begin.size())) !=
           ends.end();
}

}  // namespace

void check_covers(const TemperatureField& field, std::span<const Instant> wanted,
                  const fs::path& file) {
    double apart = 0.0;
    for (std::size_t i = 1; i < field.instant.size(); ++i) {
        apart = std::max(apart, seconds_between(field.instant[i - 1], field.instant[i]));
    }
    for (const Instant when : wanted) {
        if (seconds_between(when, field.instant.front()) <= apart &&
            seconds_between(field.instant.back(), when) <= apart) {
            continue;
        }
        throw InputError(file.string(),
                         fmt::format("has temperatures from {} to {}, expected some at {}",
                                     format_instant(field.instant.front()),
                                     format_instant(field.instant.back()), format_instant(when)));
    }
}

TemperatureField load_temperature_field(const fs::path& path) {
    const auto fail = [&](const std::string& problem) -> InputError {
        return InputError(path.string(), problem);
    };
    if (!fs::is_regular_file(path)) throw fail("no such file");
    int id = -1;
    note_file_read(path);
    check_values_are_its_own(path);
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id); status != NC_NOERR) {
        throw fail(fmt::format("is not a netCDF file ({})", nc_strerror(status)));
    }
    const NetcdfFile file(path, id);
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
    if (rank != 2) throw fail("surface_temperature does not have the dimensions (time, facet)");
    must(nc_inq_vardimid(id, kelvin, dims), "shape");
    int time_rank, time_of_time;
    must(nc_inq_varndims(id, time, &time_rank), "times");
    if (time_rank != 1) throw fail("time does not have the dimension (time)");
    if (!counts_from_1970(file, time)) {
        throw fail("its time is not in 'seconds since 1970-01-01T00:00:00Z'");
    }
    must(nc_inq_vardimid(id, time, &time_of_time), "times");
    if (dims[0] != time_dim || dims[1] != facet_dim || time_of_time != time_dim) {
        throw fail("surface_temperature does not have the dimensions (time, facet)");
    }
    if (instants == 0 || facets == 0) throw fail("has no temperatures");
    // A short header may claim any size; what is stored compressed is at least a thousandth.
    if (double(instants) * double(facets) * sizeof(float) > 2e3 * double(fs::file_size(path))) {
        throw fail("declares more temperatures than a file of this size can contain");
    }

    TemperatureField field{
        .instant = {}, .facets = facets, .kelvin = std::vector<float>(instants * facets)};
    std::vector<double> seconds(instants);
    must(nc_get_var_double(id, time, seconds.data()), "readable times");
    must(nc_get_var_float(id, kelvin, field.kelvin.data()), "readable temperatures");
    for (const double s : seconds) {
        if (!std::isfinite(s) || std::abs(s) > 1e12) throw fail("has times that are not finite");
        field.instant.push_back(later(Instant{}, s));
    }
    if (std::adjacent_find(field.instant.begin(), field.instant.end(), std::greater_equal<>()) !=
        field.instant.end()) {
        throw fail("has times that are not ascending");
    }
    if (std::any_of(field.kelvin.begin(), field.kelvin.end(),
                    [](float t) { return !(t >= 1.0f && t <= 5000.0f); })) {
        throw fail("has temperatures outside 1 to 5000 K");
    }
    field.solved_as = read_solved_as(file, facets, facet_dim, path);
    field.water = read_cover(file, instants, facets, {dims[0], dims[1]}, path);
    return field;
}

std::vector<float> load_heat_term(const fs::path& path, HeatTerm term,
                                  const TemperatureField& field) {
    const std::string name = heat_term_names[static_cast<std::size_t>(term)].name;
    int id = -1, variable = -1, rank = 0;
    note_file_read(path);
    check_values_are_its_own(path);
    if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id); status != NC_NOERR) {
        throw InputError(path.string(),
                         fmt::format("is not a netCDF file ({})", nc_strerror(status)));
    }
    const NetcdfFile file(path, id);
    if (nc_inq_varid(id, name.c_str(), &variable) != NC_NOERR) return {};
    std::array<int, NC_MAX_VAR_DIMS> dims{};
    std::size_t instants = 0, facets = 0;
    const bool fits = nc_inq_varndims(id, variable, &rank) == NC_NOERR && rank == 2 &&
                      nc_inq_vardimid(id, variable, dims.data()) == NC_NOERR &&
                      nc_inq_dimlen(id, dims[0], &instants) == NC_NOERR &&
                      nc_inq_dimlen(id, dims[1], &facets) == NC_NOERR &&
                      instants == field.instant.size() && facets == field.facets;
    if (!fits)
        throw InputError(path.string(), name + " does not have the shape of the temperatures");
    std::vector<float> watts(instants * facets);
    if (nc_get_var_float(id, variable, watts.data()) != NC_NOERR ||
        !std::all_of(watts.begin(), watts.end(), [](float w) { return std::isfinite(w); })) {
        throw InputError(path.string(), name + " is not readable or not finite");
    }
    return watts;
}

}  // namespace diurna
