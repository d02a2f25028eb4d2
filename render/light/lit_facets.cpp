#include "render/light/lit_facets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/light/incident_light.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// Steps from the eye: 1 seen, 2 shines on one seen, 3 shines on one of those, 0 none of these.
std::vector<std::uint8_t> steps_from_eye(const RadianceInput& input,
                                         std::span<const FacetId> seen) {
    const ViewFactors& others = input.views.others;
    std::vector<std::uint8_t> step(input.facets.size(), 0);
    for (const FacetId id : seen) step[index(id)] = 1;
    for (std::uint8_t now = 1; now <= 2; ++now) {
        for (std::size_t f = 0; f < step.size(); ++f) {
            if (step[f] != now) continue;
            for (std::uint32_t k = others.row[f]; k < others.row[f + 1]; ++k) {
                std::uint8_t& of_source = step[index(others.facet[k])];
                if (of_source == 0) of_source = static_cast<std::uint8_t>(now + 1);
            }
        }
    }
    return step;
}

/// (material) greatest reflectance in a band of those that are used.
std::vector<float> greatest_reflectances(const Band& band, const RadianceInput& input,
                                         const LitFacets& lit) {
    std::vector<float> greatest(input.materials.size(), 0.0f);
    for (std::size_t m = 0; m < greatest.size(); ++m) {
        if (!lit.material_used[m]) continue;
        const Material& material = input.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        for (const double um : band.node_um) {
            greatest[m] = std::max(greatest[m], static_cast<float>(material.reflectance.at(um)));
        }
    }
    return greatest;
}

ReflectionBounds bounds_of(const Band& band, const RadianceInput& input, const LitFacets& lit,
                           std::span<const std::uint8_t> step) {
    const std::vector<float> greatest = greatest_reflectances(band, input, lit);
    const auto whole = [&](std::size_t i) {
        return greatest[index(lit.material[i])] * (1.0f - lit.sky_view[i]);
    };
    const auto response = [&](std::size_t i) {
        return lit.row[i] == lit.row[i + 1] ? 0.0f : whole(i);
    };
    ReflectionBounds bounds;
    bounds.twice.assign(lit.facet.size(), 0.0f);
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        if (step[index(lit.facet[i])] != 1) continue;
        const float r = response(i);
        if (r > 0.0f) bounds.surrounded = std::max(bounds.surrounded, 1.0f - lit.sky_view[i]);
        for (std::uint32_t k = lit.row[i]; k < lit.row[i + 1]; ++k) {
            float& most = bounds.twice[lit.source[k]];
            most = std::max(most, r);
        }
    }
    // The rows of the third facet may be left out of `lit`, but not its sky view.
    float most_twice = 0.0f, third = 0.0f;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        bounds.twice[i] *= response(i);
        most_twice = std::max(most_twice, bounds.twice[i]);
        third = std::max(third, whole(i));
    }
    bounds.thrice = most_twice * third;
    return bounds;
}

/// Which facets shine on each of those that are seen or shine on one seen.
///
/// - place: (facet of the scene) index in `lit`
void add_sources(const FacetViews& views, std::span<const std::uint8_t> step,
                 std::span<const std::uint32_t> place, LitFacets& lit) {
    const auto has_row = [&](FacetId facet) { return step[index(facet)] <= 2; };
    std::size_t entries = 0;
    for (const FacetId facet : lit.facet) {
        const std::size_t f = index(facet);
        if (has_row(facet)) entries += views.others.row[f + 1] - views.others.row[f];
    }
    lit.row.reserve(lit.facet.size() + 1);
    lit.source.reserve(entries);
    lit.factor.reserve(entries);
    lit.row.push_back(0);
    lit.is_source.assign(lit.facet.size(), 0);
    for (const FacetId facet : lit.facet) {
        if (has_row(facet)) {
            each_seen_facet(views, facet, [&](FacetId from, double factor) {
                lit.source.push_back(place[index(from)]);
                lit.is_source[place[index(from)]] = 1;
                lit.factor.push_back(static_cast<float>(factor));
            });
        }
        lit.row.push_back(static_cast<std::uint32_t>(lit.source.size()));
    }
}

void set_heights(const RadianceInput& input, LitFacets& lit) {
    lit.height.assign(lit.facet.size(), 0.0f);
    if (lit.facet.empty()) return;
    std::vector<double> height_km;
    height_km.reserve(lit.facet.size());
    for (const FacetId facet : lit.facet) height_km.push_back(input.height_km(facet));
    const auto [least, most] = std::minmax_element(height_km.begin(), height_km.end());
    lit.height_km = {*least, 0.5 * (*least + *most), *most};
    const double half = lit.height_km[1] - lit.height_km[0];
    for (std::size_t i = 0; i < lit.facet.size() && half > 1e-6; ++i) {
        lit.height[i] = static_cast<float>((height_km[i] - lit.height_km[1]) / half);
    }
}

}  // namespace

LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen,
                     std::span<const Band> bands) {
    const std::vector<std::uint8_t> step = steps_from_eye(input, seen);
    LitFacets lit;
    lit.material_used.assign(input.materials.size(), false);
    std::vector<std::uint32_t> place(input.facets.size(), 0);  // in `lit`
    for (std::size_t f = 0; f < place.size(); ++f) {
        if (step[f] == 0) continue;
        place[f] = static_cast<std::uint32_t>(lit.facet.size());
        lit.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
        lit.material.push_back(input.facets.material[f]);
        lit.sky_view.push_back(input.views.sky[f]);
        lit.material_used[index(input.facets.material[f])] = true;
    }
    for (const FacetId id : seen) lit.target.push_back(place[index(id)]);
    add_sources(input.views, step, place, lit);
    set_heights(input, lit);
    for (const Band& band : bands) lit.bounds.push_back(bounds_of(band, input, lit, step));
    return lit;
}

LitState lit_state(const RadianceInput& input, const LitFacets& lit) {
    const std::size_t n = lit.facet.size();
    LitState state;
    state.temperature.resize(n);
    state.sunlight.assign(n, 0.0f);
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
    return state;
}

}  // namespace diurna
