#include "render/light/lit_facets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/light/incident_light.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

constexpr float most_returned = 0.99f;

/// (material) greatest reflectance in a band.
std::vector<float> greatest_reflectances(const Band& band, const MaterialLibrary& materials,
                                         const std::vector<bool>& used) {
    std::vector<float> greatest(materials.size(), 0.0f);
    for (std::size_t m = 0; m < greatest.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        for (const double um : band.node_um) {
            greatest[m] = std::max(greatest[m], static_cast<float>(material.reflectance.at(um)));
        }
    }
    return greatest;
}

/// (facet) greatest reflectance in any band × (1 − sky view).
std::vector<float> returned_by(const RadianceInput& input, std::span<const Band> bands) {
    std::vector<bool> used(input.materials.size(), false);
    for (const MaterialId id : input.facets.material) used[index(id)] = true;
    std::vector<float> greatest(input.materials.size(), 0.0f);
    for (const Band& band : bands) {
        const std::vector<float> here = greatest_reflectances(band, input.materials, used);
        for (std::size_t m = 0; m < here.size(); ++m) greatest[m] = std::max(greatest[m], here[m]);
    }
    std::vector<float> returned(input.facets.size());
    for (std::size_t f = 0; f < returned.size(); ++f) {
        returned[f] = std::min(
            most_returned, greatest[index(input.facets.material[f])] * (1.0f - input.views.sky[f]));
    }
    return returned;
}

/// How a picture depends on the facets of the scene, (facet).
struct Reached {
    std::vector<std::uint8_t> seen, has_row;
    std::vector<float> reach;  // LitFacets::reach; below 0: nobody asks for it
};

/// From the eye along the ways of light, as long as what a facet's surroundings send matters.
Reached reached(const RadianceInput& input, std::span<const SurfaceId> seen,
                std::span<const float> returned) {
    const ViewFactors& others = input.views.others;
    const std::size_t n = input.facets.size();
    Reached found{.seen = std::vector<std::uint8_t>(n, 0),
                  .has_row = std::vector<std::uint8_t>(n, 0),
                  .reach = std::vector<float>(n, -1.0f)};
    std::vector<std::uint32_t> now, next;
    for (const SurfaceId id : seen) {
        found.seen[index(id)] = found.has_row[index(id)] = 1;
        now.push_back(number(id));
    }
    while (!now.empty()) {
        next.clear();
        for (const std::uint32_t f : now) {
            const float on = (found.seen[f] ? 1.0f : found.reach[f]) * returned[f];
            for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
                const std::uint32_t source = others.facet[k];
                float& best = found.reach[source];
                if (best >= on) continue;
                best = on;
                if (found.seen[source] || best * returned[source] < least_reach) continue;
                found.has_row[source] = 1;
                next.push_back(source);
            }
        }
        now.swap(next);
    }
    return found;
}

ReflectionBounds bounds_of(const Band& band, const RadianceInput& input, const LitFacets& lit) {
    const std::vector<float> greatest =
        greatest_reflectances(band, input.materials, lit.material_used);
    ReflectionBounds bounds;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const float returned = greatest[index(lit.material[i])] * (1.0f - lit.sky_view[i]);
        bounds.strongest = std::max(bounds.strongest, std::min(returned, most_returned));
    }
    for (const std::uint32_t i : lit.target) {
        if (lit.row[i] == lit.row[i + 1] || greatest[index(lit.material[i])] == 0.0f) continue;
        bounds.surrounded = std::max(bounds.surrounded, 1.0f - lit.sky_view[i]);
    }
    return bounds;
}

/// Which facets shine on each of those whose surroundings matter.
///
/// - place: (facet of the scene) index in `lit`
void add_sources(const FacetViews& views, const Reached& found,
                 std::span<const std::uint32_t> place, LitFacets& lit) {
    std::size_t entries = 0;
    for (const SurfaceId facet : lit.facet) {
        const std::size_t f = index(facet);
        if (found.has_row[f]) entries += views.others.row[f + 1] - views.others.row[f];
    }
    lit.row.reserve(lit.facet.size() + 1);
    lit.source.reserve(entries);
    lit.factor.reserve(entries);
    lit.row.push_back(0);
    lit.is_source.assign(lit.facet.size(), 0);
    for (const SurfaceId facet : lit.facet) {
        if (found.has_row[index(facet)]) {
            each_seen_facet(views, facet, [&](SurfaceId from, double factor) {
                lit.source.push_back(place[index(from)]);
                lit.is_source[place[index(from)]] = 1;
                lit.factor.push_back(static_cast<float>(factor));
            });
        }
        lit.row.push_back(static_cast<std::uint32_t>(lit.source.size()));
    }
}

/// Facets on both sides of a height at which light has a step.
void set_heights_about_edge(const std::vector<double>& height_km, double edge_km, LitFacets& lit) {
    double least = edge_km, below = -1e9, above = 1e9, most = edge_km;
    for (const double z : height_km) {
        least = std::min(least, z);
        most = std::max(most, z);
        if (z < edge_km) below = std::max(below, z);
        if (z >= edge_km) above = std::min(above, z);
    }
    lit.height_km = {least, below, 0.5 * (above + most)};
    const double span = std::max(1e-6, below - least);
    for (std::size_t i = 0; i < height_km.size(); ++i) {
        lit.height[i] = height_km[i] >= edge_km
                            ? height_above_edge
                            : straight_height + static_cast<float>(std::clamp(
                                                    (height_km[i] - least) / span, 0.0, 1.0));
    }
}

void set_heights(const RadianceInput& input, LitFacets& lit) {
    lit.height.assign(lit.facet.size(), 0.0f);
    if (lit.facet.empty()) return;
    std::vector<double> height_km;
    height_km.reserve(lit.facet.size());
    for (const SurfaceId facet : lit.facet) height_km.push_back(input.height_km(facet));
    const auto [least, most] = std::minmax_element(height_km.begin(), height_km.end());
    if (*least < input.light_edge_km && *most >= input.light_edge_km) {
        set_heights_about_edge(height_km, input.light_edge_km, lit);
        return;
    }
    lit.height_km = {*least, 0.5 * (*least + *most), *most};
    const double half = lit.height_km[1] - lit.height_km[0];
    for (std::size_t i = 0; i < lit.facet.size() && half > 1e-6; ++i) {
        lit.height[i] = static_cast<float>((height_km[i] - lit.height_km[1]) / half);
    }
}

}  // namespace

LitFacets lit_facets(const RadianceInput& input, std::span<const SurfaceId> seen,
                     std::span<const Band> bands) {
    const std::vector<float> returned = returned_by(input, bands);
    const Reached found = reached(input, seen, returned);
    LitFacets lit;
    lit.material_used.assign(input.materials.size(), false);
    std::vector<std::uint32_t> place(input.facets.size(), 0);  // in `lit`
    for (std::size_t f = 0; f < place.size(); ++f) {
        if (!found.seen[f] && found.reach[f] < 0.0f) continue;
        place[f] = static_cast<std::uint32_t>(lit.facet.size());
        lit.facet.push_back(surface_id(f));
        lit.material.push_back(input.facets.material[f]);
        lit.sky_view.push_back(input.views.sky[f]);
        lit.reach.push_back(std::max(0.0f, found.reach[f]));
        lit.returned.push_back(returned[f]);
        lit.material_used[index(input.facets.material[f])] = true;
    }
    for (const SurfaceId id : seen) lit.target.push_back(place[index(id)]);
    add_sources(input.views, found, place, lit);
    set_heights(input, lit);
    for (const Band& band : bands) lit.bounds.push_back(bounds_of(band, input, lit));
    return lit;
}

namespace {

/// Where the sky that facets see lies, of those that see little of it: of the ones seen, and of
/// those whose light makes up a hundredth of another's (of the rest a hundredth of what the views
/// change, a few per cent of reflected skylight, is lost).
void set_narrow_views(const RadianceInput& input, const LitFacets& lit, LitState& state) {
    constexpr float least_share = 0.01f;
    state.narrow_place.assign(lit.facet.size(), 0);
    std::vector<bool> counts(lit.facet.size());
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = lit.reach[i] >= least_share;
    for (const std::uint32_t i : lit.target) counts[i] = true;
    std::vector<SurfaceId> facet;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        if (!counts[i] || narrowness(lit.sky_view[i]) == 0.0f) continue;
        facet.push_back(lit.facet[i]);
        state.narrow_place[i] = static_cast<std::uint32_t>(facet.size());
    }
    state.narrow.resize(facet.size());
    for_each_block(facet.size(), 64, [&](std::size_t begin, std::size_t end) {
        narrow_views(input, std::span(facet).subspan(begin, end - begin),
                     std::span(state.narrow).subspan(begin, end - begin));
    });
}

}  // namespace

LitState lit_state(const RadianceInput& input, const LitFacets& lit, std::span<const Band> bands) {
    const std::size_t n = lit.facet.size();
    LitState state;
    state.temperature.resize(n);
    state.sunlight.assign(n, 0.0f);
    state.uneven.resize(n);
    if (n == 0) return state;
    const Eigen::Vector3f to_sun = input.to_sun.cast<float>();
    constexpr std::size_t grain = 8192;
    std::vector<TemperatureExtent> extents((n + grain - 1) / grain);
    for_each_block(n, grain, [&](std::size_t begin, std::size_t end) {
        TemperatureExtent extent{.coldest = 1e30f, .hottest = 0.0f};
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t f = index(lit.facet[i]);
            const float temperature = input.temperature[f];
            if (!(temperature >= 1.0f && temperature <= 5000.0f)) {
                throw InputError(
                    fmt::format("facet {}", f),
                    fmt::format("has a temperature of {} K, expected 1 to 5000", temperature));
            }
            state.temperature[i] = temperature;
            state.uneven[i] = uneven_view(input, lit.facet[i]);
            extent.coldest = std::min(extent.coldest, temperature);
            extent.hottest = std::max(extent.hottest, temperature);
            if (!input.sun_fraction.empty() && input.sun_fraction[f] > 0.0f) {
                state.sunlight[i] =
                    sunlight_on(input.sun_fraction[f], input.facets.normal[f].dot(to_sun));
            }
        }
        extents[begin / grain] = extent;
    });
    state.extent = {.coldest = 1e30f, .hottest = 0.0f};
    for (const TemperatureExtent& e : extents) {
        state.extent.coldest = std::min(state.extent.coldest, e.coldest);
        state.extent.hottest = std::max(state.extent.hottest, e.hottest);
    }
    const bool sunlit = std::any_of(bands.begin(), bands.end(), [&](const Band& band) {
        return has_scattered_sun(input, band.node_um);
    });
    if (sunlit) set_narrow_views(input, lit, state);
    return state;
}

}  // namespace diurna
