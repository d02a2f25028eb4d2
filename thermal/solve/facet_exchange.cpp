#include "thermal/solve/facet_exchange.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

/// Σ factor · value over a facet's row.
double gathered(const ViewFactors& exchange, std::size_t facet, std::span<const float> value) {
    double sum = 0.0;
    for (std::uint32_t k = exchange.row[facet]; k < exchange.row[facet + 1]; ++k) {
        sum += double(exchange.factor[k]) * value[index(exchange.facet[k])];
    }
    return sum;
}

}  // namespace

FacetOptics facet_optics(const FacetSet& facets, const MaterialLibrary& materials) {
    FacetOptics optics;
    optics.albedo.reserve(facets.size());
    optics.emissivity.reserve(facets.size());
    for (const MaterialId id : facets.material) {
        optics.albedo.push_back(float(materials[id].thermal.albedo));
        optics.emissivity.push_back(float(materials[id].thermal.emissivity));
    }
    return optics;
}

void incident_sunlight(const ExchangingFacets& scene, const SkyState& sky,
                       std::span<const float> fraction, std::span<float> incident) {
    const FacetViews& view = scene.views;
    const std::vector<float>& albedo = scene.optics.albedo;
    const std::size_t n = scene.facets.size();
    const double global = sky.global_horizontal();
    if (global <= 0.0) {
        std::fill(incident.begin(), incident.end(), 0.0f);
        return;
    }
    std::vector<float> own(n), reflected(n);
    for (std::size_t f = 0; f < n; ++f) {
        const double cosine = scene.facets.normal[f].cast<double>().dot(sky.to_sun);
        // The fraction counts the facet's own turning away already.
        const double lit = fraction.empty() ? 1.0 : fraction[f];
        double light = facet_sunlight(sky, cosine, lit, view.sky[f]);
        if (scene.exchange) light += double(view.below[f]) * albedo[f] * global;
        own[f] = incident[f] = float(light);
    }
    if (!scene.exchange || view.others.facet.empty()) return;
    for (int bounce = 0; bounce < 2; ++bounce) {
        for (std::size_t f = 0; f < n; ++f) reflected[f] = albedo[f] * incident[f];
        for (std::size_t f = 0; f < n; ++f) {
            incident[f] = float(own[f] + gathered(view.others, f, reflected));
        }
    }
}

void arriving_longwave(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                       std::span<float> excess) {
    const std::size_t instants = excess.size();
    const auto add = [&](std::size_t from, float factor, bool first) {
        const float* sent = leaving.data() + from * instants;
        if (first) {
            for (std::size_t i = 0; i < instants; ++i) excess[i] = factor * sent[i];
        } else {
            for (std::size_t i = 0; i < instants; ++i) excess[i] += factor * sent[i];
        }
    };
    add(facet, view.below[facet], true);
    for (auto k = view.others.row[facet]; k < view.others.row[facet + 1]; ++k) {
        add(index(view.others.facet[k]), view.others.factor[k], false);
    }
}

}  // namespace diurna
