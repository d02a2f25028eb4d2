#include "thermal/temperature_field.hpp"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/made_by.hpp"
#include "terrain/place/local_time.hpp"
#include "thermal/netcdf/netcdf_writer.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

/// The rows on either side of an instant, and its way from one to the other; twice the same beyond
/// the ends.
struct Between {
    std::size_t low, high;
    double share = 0.0;
};
Between rows_around(const std::vector<Instant>& instant, Instant when) {
    assert(!instant.empty());
    const auto after = std::upper_bound(instant.begin(), instant.end(), when);
    const auto i = static_cast<std::size_t>(after - instant.begin());
    if (i == 0) return {0, 0};
    if (i == instant.size()) return {i - 1, i - 1};
    return {i - 1, i,
            seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i])};
}

/// What a temperature field's file holds.
struct Variables {
    int corner, time, kelvin, clock, solar;
    int material = -1, object = -1;        // (facet)
    std::array<int, 3> axis;               // east, north, up
    int solved_as = -1;                    // (facet)
    std::array<int, heat_terms> term{};    // (time, facet), if there are fluxes
    std::array<int, 3> cover{-1, -1, -1};  // likewise, where water or snow lies on any facet
};

constexpr const char* heat_equation =
    "absorbed_sunlight + absorbed_longwave + internal_heat = emitted_longwave + sensible_heat + "
    "latent_heat + melting_heat + conducted_heat, on every facet at every time, per square metre "
    "of the facet's front; between the solver's steps both sides are interpolated linearly";

/// Names that are more than an attribute holds: a variable NAME_name, which the attribute
/// `flag_meanings_variable` of the numbers' own names.
void declare_long_names(const NetcdfWriter& file, int variable, const char* name,
                        const std::vector<std::string>& meanings) {
    const std::string names = std::string(name) + "_name";
    std::vector<std::string> words;
    for (const std::string& meaning : meanings) words.push_back(flag_word(meaning));
    std::vector<const char*> text;
    for (const std::string& word : words) text.push_back(word.c_str());
    const int all =
        file.variable(names.c_str(), NC_STRING, {file.dimension(names.c_str(), words.size())});
    file.text(all, "long_name", std::string(name) + ": meaning of its values, from 0");
    file.text(variable, "flag_meanings_variable", names);
    file.must(nc_put_var_string(file.id(), all, text.data()));
}

/// A number for each facet, and what the numbers mean.
int declare_flags(const NetcdfWriter& file, const char* name, int facet_dim,
                  const std::vector<std::string>& meanings) {
    const int variable = file.variable(name, NC_INT, {facet_dim});
    std::vector<int> values;
    std::string words;
    for (std::size_t i = 0; i < meanings.size(); ++i) {
        values.push_back(int(i));
        if (i > 0) words += ' ';
        words += flag_word(meanings[i]);
    }
    if (words.size() <= most_attribute_bytes &&
        sizeof(int) * values.size() <= most_attribute_bytes) {
        file.must(nc_put_att_int(file.id(), variable, "flag_values", NC_INT, values.size(),
                                 values.data()));
        file.text(variable, "flag_meanings", words);
    } else {
        declare_long_names(file, variable, name, meanings);
    }
    file.text(variable, "long_name", std::string(name) + " of the facet");
    file.text(variable, "mesh", "mesh");
    file.text(variable, "location", "face");
    return variable;
}

void declare_times(const NetcdfWriter& file, int time_dim, Variables& variables) {
    variables.time = file.variable("time", NC_DOUBLE, {time_dim});
    file.text(variables.time, "standard_name", "time");
    file.text(variables.time, "units", "seconds since 1970-01-01T00:00:00Z");
    file.text(variables.time, "calendar", "standard");
    variables.clock = file.variable("local_time", NC_STRING, {time_dim});
    file.text(variables.clock, "long_name", "time on the scene's clock, with its UTC offset");
    variables.solar = file.variable("solar_time", NC_DOUBLE, {time_dim});
    file.text(variables.solar, "long_name", "apparent solar time at the site: 12 is true noon");
    file.text(variables.solar, "units", "hour");
}

/// A variable (time, facet).
int declare_field(const NetcdfWriter& file, const char* name, const char* standard_name,
                  const std::string& units, const std::array<int, 2>& dims) {
    const int variable = file.variable(name, NC_FLOAT, {dims[0], dims[1]});
    if (*standard_name != '\0') file.text(variable, "standard_name", standard_name);
    file.text(variable, "units", units);
    file.text(variable, "mesh", "mesh");
    file.text(variable, "location", "face");
    return variable;
}

void declare_fluxes(const NetcdfWriter& file, const std::array<int, 2>& dims,
                    Variables& variables) {
    file.text(NC_GLOBAL, "heat_balance", heat_equation);
    for (std::size_t k = 0; k < heat_terms; ++k) {
        const TermName& term = heat_term_names[k];
        variables.term[k] = declare_field(file, term.name, term.standard_name, "W m-2", dims);
        file.text(variables.term[k], "long_name", term.long_name);
        const int sign = k < heat_sources ? 1 : -1;
        file.must(nc_put_att_int(file.id(), variables.term[k], "balance_sign", NC_INT, 1, &sign));
    }
}

/// Of what lies there, what is anywhere.
void declare_cover(const NetcdfWriter& file, const CoveredFacets& water,
                   const std::array<int, 2>& dims, Variables& variables) {
    for (std::size_t k = 0; k < cover_names.size(); ++k) {
        const CoverName& of = cover_names[k];
        if (std::none_of(water.cover.begin(), water.cover.end(),
                         [&](const SurfaceCover& cover) { return cover.*of.value > 0.0f; })) {
            continue;
        }
        variables.cover[k] = declare_field(file, of.name, of.standard_name, "1", dims);
        file.text(variables.cover[k], "long_name", of.long_name);
    }
}

/// Dimensions, variables and their attributes: what a reader learns before any number.
Variables declare(const NetcdfWriter& file, const TemperatureField& field, const FacetSet& facets,
                  const Site& site, const FieldNotes& notes) {
    const int time_dim = file.dimension("time", field.instant.size());
    const int facet_dim = file.dimension("facet", field.facets);
    const int vertex_dim = file.dimension("vertex", facets.vertex.size());
    const int three = file.dimension("corner", 3);

    file.text(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
    file.text(NC_GLOBAL, "title", temperatures_title);
    file.text(NC_GLOBAL, "source", made_by());
    file.text(NC_GLOBAL, "libraries", made_with());
    if (!notes.made_of.empty()) file.text(NC_GLOBAL, made_of_name, notes.made_of);
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
    declare_times(file, time_dim, variables);
    if (!notes.materials.empty()) {
        variables.material = declare_flags(file, "material", facet_dim, notes.materials);
    }
    if (!notes.objects.empty()) {
        variables.object = declare_flags(file, "object", facet_dim, notes.objects);
    }
    if (!field.solved_as.empty()) {
        variables.solved_as = file.variable(solved_as_name, NC_INT, {facet_dim});
        file.text(
            variables.solved_as, "long_name",
            "representative facet whose temperatures this facet has: itself where it was solved, "
            "otherwise a representative, because no picture of the run shows this facet");
        if (field.representative_rms > 0.0) {
            file.must(nc_put_att_double(file.id(), variables.solved_as, representative_rms_name,
                                        NC_DOUBLE, 1, &field.representative_rms));
        }
        file.text(variables.solved_as, "mesh", "mesh");
        file.text(variables.solved_as, "location", "face");
    }
    const std::array<int, 2> dims{time_dim, facet_dim};
    variables.kelvin = declare_field(file, "surface_temperature", "surface_temperature", "K", dims);
    if (notes.fluxes) declare_fluxes(file, dims, variables);
    if (!field.water.empty()) declare_cover(file, field.water, dims, variables);
    file.must(nc_enddef(file.id()));
    return variables;
}

void write_mesh(const NetcdfWriter& file, const Variables& variables, const FacetSet& facets) {
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

void write_names(const NetcdfWriter& file, const Variables& variables, const FacetSet& facets) {
    std::vector<int> number(facets.size());
    if (variables.material >= 0) {
        std::transform(facets.material.begin(), facets.material.end(), number.begin(),
                       [](MaterialId id) { return int(index(id)); });
        file.must(nc_put_var_int(file.id(), variables.material, number.data()));
    }
    if (variables.object >= 0) {
        std::transform(facets.object.begin(), facets.object.end(), number.begin(),
                       [](ObjectId id) { return int(id); });
        file.must(nc_put_var_int(file.id(), variables.object, number.data()));
    }
}

void write_solved_as(const NetcdfWriter& file, const Variables& variables,
                     const TemperatureField& field) {
    if (variables.solved_as < 0) return;
    const std::vector<int> number(field.solved_as.begin(), field.solved_as.end());
    file.must(nc_put_var_int(file.id(), variables.solved_as, number.data()));
}

void write_times(const NetcdfWriter& file, const Variables& variables,
                 const std::vector<Instant>& instants, const Site& site, double utc_offset) {
    std::vector<double> seconds, solar;
    std::vector<std::string> clock;
    std::vector<const char*> text;
    for (const Instant when : instants) {
        seconds.push_back(seconds_between(Instant{}, when));
        solar.push_back(solar_time_h(site, when));
        clock.push_back(format_local(when, utc_offset));
    }
    for (const std::string& at : clock) text.push_back(at.c_str());
    file.must(nc_put_var_double(file.id(), variables.time, seconds.data()));
    file.must(nc_put_var_double(file.id(), variables.solar, solar.data()));
    file.must(nc_put_var_string(file.id(), variables.clock, text.data()));
}

void write_fluxes(const NetcdfWriter& file, const Variables& variables,
                  const HeatFluxField& fluxes) {
    for (std::size_t k = 0; k < heat_terms; ++k) {
        file.must(nc_put_var_float(file.id(), variables.term[k], fluxes.watts[k].data()));
    }
}

/// All facets: those whose water is not followed are dry. At once, as the file packs it in pieces
/// of many instants.
void write_cover(const NetcdfWriter& file, const Variables& variables,
                 const TemperatureField& field) {
    const CoveredFacets& water = field.water;
    std::vector<float> values;
    for (std::size_t k = 0; k < cover_names.size(); ++k) {
        if (variables.cover[k] < 0) continue;
        values.assign(field.instant.size() * field.facets, 0.0f);
        for (std::size_t i = 0; i < field.instant.size(); ++i) {
            const std::span<const SurfaceCover> cover = water.at(i);
            for (std::size_t n = 0; n < cover.size(); ++n) {
                values[i * field.facets + water.facet[n]] = cover[n].*cover_names[k].value;
            }
        }
        file.must(nc_put_var_float(file.id(), variables.cover[k], values.data()));
    }
}

}  // namespace

std::vector<float> TemperatureField::interpolate(Instant when) const {
    const Between rows = rows_around(instant, when);
    const auto a = at(rows.low), b = at(rows.high);
    if (rows.low == rows.high) return {a.begin(), a.end()};
    const auto share = float(rows.share);
    std::vector<float> result(facets);
    for (std::size_t f = 0; f < facets; ++f) result[f] = a[f] + share * (b[f] - a[f]);
    return result;
}

std::vector<SurfaceCover> TemperatureField::cover_at(Instant when) const {
    const Between rows = rows_around(instant, when);
    return water.between(rows.low, rows.high, rows.share);
}

void save_temperature_field(const fs::path& path, const TemperatureField& field,
                            const FacetSet& facets, const Site& site, const FieldNotes& notes) {
    assert(field.facets == facets.size());
    assert(field.solved_as.empty() || field.solved_as.size() == field.facets);
    const auto bad = std::find_if_not(field.kelvin.begin(), field.kelvin.end(),
                                      [](float kelvin) { return std::isfinite(kelvin); });
    if (bad != field.kelvin.end()) {
        throw std::runtime_error(
            fmt::format("{}: the temperature of facet {} is not finite", path.string(),
                        static_cast<std::size_t>(bad - field.kelvin.begin()) % field.facets));
    }
    NetcdfWriter file = NetcdfWriter::create(path);
    const Variables variables = declare(file, field, facets, site, notes);
    write_mesh(file, variables, facets);
    write_names(file, variables, facets);
    write_solved_as(file, variables, field);
    write_times(file, variables, field.instant, site, notes.utc_offset);
    file.must(nc_put_var_float(file.id(), variables.kelvin, field.kelvin.data()));
    if (notes.fluxes) {
        assert(notes.fluxes->instant == field.instant);
        write_fluxes(file, variables, *notes.fluxes);
    }
    if (!field.water.empty()) write_cover(file, variables, field);
    file.finish();
}

}  // namespace diurna
