#include "scenes/job/run/covered_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "materials/matter/covered_material.hpp"

namespace diurna {

namespace {

constexpr float least_snow = 1e-3f;

/// Whether a picture shows it.
bool shows(const ThermalSurface& surface, const SurfaceCover& cover) {
    return cover.snow > least_snow || (cover.wet > 0.0f && surface.store.wet_albedo >= 0.0);
}

/// Facets of one material that are alike.
using State = std::array<int, 4>;  // material, snow share, snow albedo, wet share
struct Members {
    std::vector<std::uint32_t> place;
    double area = 0.0, wet = 0.0, snow = 0.0, white = 0.0;  // sums over area; white over snow's
};

State state_of(const ThermalSurface& surface, std::size_t material, const SurfaceCover& cover,
               double step) {
    const auto rounded = [](double value, double width) { return int(std::lround(value / width)); };
    const bool snow = cover.snow > least_snow, wet = surface.store.wet_albedo >= 0.0;
    return {int(material), snow ? 1 + rounded(double(cover.snow), step) : 0,
            snow ? rounded(double(cover.snow_albedo), step) : 0,
            wet ? rounded(double(cover.wet), 2.0 * step) : 0};
}

std::map<State, Members> states(const FacetSet& facets, const MaterialLibrary& materials,
                                std::span<const std::uint32_t> facet,
                                std::span<const SurfaceCover> cover, double step) {
    std::map<State, Members> all;
    for (std::size_t k = 0; k < facet.size(); ++k) {
        const MaterialId id = facets.material[facet[k]];
        const ThermalSurface& surface = materials[id].thermal;
        if (!shows(surface, cover[k])) continue;
        Members& members = all[state_of(surface, index(id), cover[k], step)];
        const double area = double(facets.area[facet[k]]), snow = double(cover[k].snow);
        members.place.push_back(std::uint32_t(k));
        members.area += area;
        members.wet += area * double(cover[k].wet);
        members.snow += area * snow;
        members.white += area * snow * double(cover[k].snow_albedo);
    }
    return all;
}

MaterialCover mean_of(const Members& of) {
    return {.wet = of.wet / of.area,
            .snow = of.snow / of.area,
            .snow_albedo = of.snow > 0.0 ? of.white / of.snow : 0.0};
}

}  // namespace

std::string CoveredSurfaces::note() const {
    return fmt::format(
        "snow and water: the pictures group {} facets into {} states of snow and wetness; the "
        "group's albedo differs from a facet's own by at most {:.2g}",
        covered, states, widest);
}

std::optional<CoveredSurfaces> covered_surfaces(const FacetSet& facets,
                                                const MaterialLibrary& materials,
                                                std::span<const std::uint32_t> facet,
                                                std::span<const SurfaceCover> cover) {
    double step = 1.0 / 64.0;
    std::map<State, Members> found = states(facets, materials, facet, cover, step);
    if (found.empty()) return std::nullopt;
    while (found.size() > CoveredSurfaces::most_states && step < 1.0) {
        step *= 2.0;
        found = states(facets, materials, facet, cover, step);
    }
    CoveredSurfaces surfaces{.facets = facets, .materials = {}, .of = {}};
    std::vector<Material> all;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        surfaces.of.push_back(MaterialId(m));
        all.push_back(materials[MaterialId(m)]);
    }
    for (const auto& [state, members] : found) {
        const MaterialId dry{static_cast<std::uint16_t>(state[0])};
        const ThermalSurface& surface = materials[dry].thermal;
        Material covered = covered_material(materials[dry], mean_of(members));
        for (const std::uint32_t k : members.place) {
            surfaces.facets.material[facet[k]] = MaterialId(all.size());
            surfaces.widest = std::max(surfaces.widest, std::abs(covered_albedo(surface, cover[k]) -
                                                                 covered.thermal.albedo));
        }
        surfaces.covered += members.place.size();
        ++surfaces.states;
        covered.varies = materials[dry].kind();
        covered.name = fmt::format("{} under cover {}", materials[dry].name, all.size());
        surfaces.of.push_back(dry);
        all.push_back(std::move(covered));
    }
    surfaces.materials = MaterialLibrary(std::move(all));
    return surfaces;
}

void name_as_dry(const CoveredSurfaces& surfaces, Frame& frame) {
    for (Plane& plane : frame.planes) {
        if (plane.name != "material" && plane.name.rfind("material_", 0) != 0) continue;
        for (float& id : plane.pixel) {
            if (id >= 0.0f) id = float(index(surfaces.of[static_cast<std::size_t>(id)]));
        }
    }
}

void add_cover_planes(const View& view, std::span<const std::uint32_t> facet,
                      std::span<const SurfaceCover> cover, Frame& frame) {
    std::vector<SurfaceCover> of_facet(view.facets);
    for (std::size_t k = 0; k < facet.size(); ++k) {
        if (facet[k] < of_facet.size()) of_facet[facet[k]] = cover[k];
    }
    std::array<Plane, 3> planes{
        {{"wet_share", "1", {}}, {"snow_cover", "1", {}}, {"snow_albedo", "1", {}}}};
    for (Plane& plane : planes) plane.pixel.assign(view.pixels(), -1.0f);
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        if (view.centre[p] == no_facet) continue;
        SurfaceCover here = of_facet[index(view.centre[p])];
        if (!view.centre_blend.empty()) {
            const Blend& blend = view.centre_blend[p];
            here = between(of_facet[index(blend.first)], of_facet[index(blend.second)],
                           double{blend.second_share});
        }
        planes[0].pixel[p] = here.wet;
        planes[1].pixel[p] = here.snow;
        planes[2].pixel[p] = here.snow > 0.0f ? here.snow_albedo : 0.0f;
    }
    for (Plane& plane : planes) frame.planes.push_back(std::move(plane));
}

}  // namespace diurna
