#include <fmt/format.h>

#include <algorithm>

#include "scenes/charts/curves.hpp"
#include "scenes/products/export/inspect.hpp"
#include "scenes/products/export/run_heat.hpp"
#include "terrain/place/local_time.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_mesh.hpp"

namespace diurna {

namespace {

/// Names of a kind that facets have, with their number and area.
FoundTable named(const std::string& what, const std::vector<NamedGroup>& groups,
                 const std::vector<float>& area) {
    FoundTable table{what + "s", {what, "facets", "area_m2"}, {}};
    for (const auto& [kind, group] : groups) {
        if (kind != what) continue;
        double sum = 0.0;
        for (const std::uint32_t f : group.facet) sum += area[f];
        table.row.push_back({group.name, static_cast<long long>(group.facet.size()), sum});
    }
    return table;
}

}  // namespace

Found inspect_temperatures(const std::filesystem::path& file) {
    const TemperatureField field = load_temperature_field(file);
    const TemperatureMesh mesh = load_temperature_mesh(file);
    const FacetSet& facets = mesh.facets;
    Found found{.kind = "temperatures of facets"};
    found.fact = {{"facets", {static_cast<long long>(field.facets)}},
                  {"vertices", {static_cast<long long>(facets.vertex.size())}},
                  {"instants", {static_cast<long long>(field.instant.size())}},
                  {"first", {format_local(field.instant.front(), mesh.utc_offset)}},
                  {"last", {format_local(field.instant.back(), mesh.utc_offset)}},
                  {"site_latitude_deg", {mesh.site.latitude_deg}},
                  {"site_longitude_deg", {mesh.site.longitude_deg}},
                  {"site_height_m", {mesh.site.height}},
                  {"water_followed_facets", {static_cast<long long>(field.water.facet.size())}},
                  {"all_facets_solved", {field.solved_as.empty()}}};
    if (!field.solved_as.empty()) {
        long long solved = 0;
        for (std::size_t f = 0; f < field.facets; ++f) solved += field.solved_as[f] == f ? 1 : 0;
        found.fact.push_back({"solved_facets", {solved}});
        found.fact.push_back({"representative_rms_K", {field.representative_rms}});
    }
    const std::vector<NamedGroup> groups = all_groups(mesh);
    for (const char* kind : {"material", "object"}) {
        found.table.push_back(named(kind, groups, facets.area));
    }
    FacetGroup all{"all", {}};
    for (std::uint32_t f = 0; f < field.facets; ++f) all.facet.push_back(f);
    FoundTable times{"temperatures", {"utc", "local_time", "least_K", "mean_K", "most_K"}, {}};
    for (std::size_t i = 0; i < field.instant.size(); ++i) {
        const auto kelvin = field.at(i);
        const auto [least, most] = std::minmax_element(kelvin.begin(), kelvin.end());
        times.row.push_back({format_instant(field.instant[i]),
                             format_local(field.instant[i], mesh.utc_offset), double{*least},
                             area_mean(all, facets.area, kelvin), double{*most}});
    }
    found.table.push_back(std::move(times));
    found.next = fmt::format(
        "diurna export FOLDER --to vtu --out day.pvd; diurna render SCENE "
        "--temperatures {}",
        file.string());
    return found;
}

}  // namespace diurna
