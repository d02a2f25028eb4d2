#include "thermal/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "materials/units.hpp"

namespace diurna {

namespace {

/// Σ factor · value over a facet's row.
double gathered(const Exchange& exchange, std::size_t facet, std::span<const float> value) {
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

void incident_sunlight(const FacetSet& facets, const SkyView& view, const FacetOptics& optics,
                       const SkyState& sky, std::span<const float> fraction, bool exchange,
                       std::span<float> incident) {
    const std::size_t n = facets.size();
    const double global = sky.global_horizontal();
    if (global <= 0.0) {
        std::fill(incident.begin(), incident.end(), 0.0f);
        return;
    }
    std::vector<float> own(n), reflected(n);
    for (std::size_t f = 0; f < n; ++f) {
        const double cosine = facets.normal[f].cast<double>().dot(sky.to_sun);
        // The fraction counts the facet's own turning away already.
        const double lit = fraction.empty() ? 1.0 : fraction[f];
        double light = facet_sunlight(sky, cosine, lit, view.sky_view[f]);
        if (exchange) light += double(view.below[f]) * optics.albedo[f] * global;
        own[f] = incident[f] = float(light);
    }
    if (!exchange || view.exchange.facet.empty()) return;
    for (int bounce = 0; bounce < 2; ++bounce) {
        for (std::size_t f = 0; f < n; ++f) reflected[f] = optics.albedo[f] * incident[f];
        for (std::size_t f = 0; f < n; ++f) {
            incident[f] = float(own[f] + gathered(view.exchange, f, reflected));
        }
    }
}

void leaving_longwave(const FacetOptics& optics, double sky_longwave,
                      std::span<const float> temperature, std::span<const float> excess,
                      std::span<float> leaving) {
    for (std::size_t f = 0; f < temperature.size(); ++f) {
        const double black = stefan_boltzmann * power4(double(temperature[f]));
        const double emissivity = optics.emissivity[f];
        leaving[f] = float(emissivity * (black - sky_longwave) + (1.0 - emissivity) * excess[f]);
    }
}

void arriving_longwave(const SkyView& view, std::span<const float> leaving, std::size_t begin,
                       std::size_t end, std::span<float> excess, std::span<float> change) {
    for (std::size_t f = begin; f < end; ++f) {
        const float next =
            float(gathered(view.exchange, f, leaving) + double(view.below[f]) * leaving[f]);
        change[f] = std::max(change[f], std::abs(next - excess[f]));
        excess[f] = next;
    }
}

}  // namespace diurna
