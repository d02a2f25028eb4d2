#include "thermal/received_light.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

namespace {

/// The albedo that the heat balance had, of facets under snow or water.
std::vector<float> albedo_at(const FacetSet& facets, const MaterialLibrary& materials,
                             const TemperatureField& field, std::size_t at,
                             std::span<const double> measured_albedo) {
    std::vector<float> albedo(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        albedo[f] = float(materials[facets.material[f]].thermal.albedo);
    }
    if (!field.water.empty()) {
        const std::span<const SurfaceCover> cover = field.water.at(at);
        for (std::size_t k = 0; k < cover.size(); ++k) {
            const std::uint32_t f = field.water.facet[k];
            albedo[f] = float(covered_albedo(materials[facets.material[f]].thermal, cover[k]));
        }
    }
    if (measured_albedo.empty()) return albedo;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const double measured = measured_albedo[index(facets.material[f])];
        if (!std::isnan(measured)) albedo[f] = float(measured);
    }
    return albedo;
}

/// What arrives from facets and from ground beyond the edge.
double from_facets(const FacetViews& views, std::size_t r, std::span<const float> beyond,
                   const std::vector<float>& leaving) {
    double sum = 0.0, seen = 0.0;
    for (auto k = views.others.row[r]; k < views.others.row[r + 1]; ++k) {
        sum += double{views.others.factor[k]} * leaving[views.others.facet[k]];
        seen += double{views.others.factor[k]};
    }
    double outside = 0.0;
    for (std::size_t f = 0; f < beyond.size(); ++f) outside += double{beyond[f]} * leaving[f];
    // Backs of sheets count as what else is seen.
    const double hidden = views.hidden.empty() ? 0.0 : double{views.hidden[r]};
    return sum + double{views.below[r]} * outside + (seen > 0.0 ? hidden * sum / seen : 0.0);
}

SkyVector sky_vector(const FacetViews& views, std::size_t r) {
    SkyVector sky{views.sky[r]};
    std::copy(views.shares[r].begin(), views.shares[r].end(), sky.begin() + 1);
    return sky;
}

}  // namespace

LeavingLight leaving_light(const FacetSet& facets, const MaterialLibrary& materials,
                           const TemperatureField& field, const HeatFluxField& heat, std::size_t at,
                           std::span<const double> measured_albedo) {
    const std::vector<float> albedo = albedo_at(facets, materials, field, at, measured_albedo);
    const std::vector<float>& sunlight = heat.of(HeatTerm::absorbed_sunlight);
    const std::vector<float>& longwave = heat.of(HeatTerm::absorbed_longwave);
    LeavingLight leaving{.sunlight = std::vector<float>(facets.size()),
                         .longwave = std::vector<float>(facets.size())};
    for_each_index(facets.size(), [&](std::size_t f) {
        const Material& material = materials[facets.material[f]];
        const ThermalSurface& surface = material.thermal;
        const std::size_t k = at * facets.size() + f;
        const double through = surface.solar_transmittance, sent = albedo[f];
        const double absorbed = 1.0 - sent - through;
        const double stops = material.see_through ? 1.0 - through : 1.0;
        if (absorbed > 0.0 && stops > 0.0) {
            leaving.sunlight[f] = float(sent / stops / absorbed * sunlight[k]);
        }
        const double kelvin = field.kelvin[k], emissivity = surface.emissivity;
        double out = emissivity * stefan_boltzmann * power4(kelvin);
        if (emissivity > 0.0) out += (1.0 / emissivity - 1.0) * longwave[k];
        leaving.longwave[f] = float(out);
    });
    return leaving;
}

ReceivedLight received_light(const ReceiverView& view, std::size_t r, double seen,
                             const SkyState& sky, const LeavingLight& leaving) {
    const SkyVector sunny = sky_vector(view.sunlight, r), warm = sky_vector(view.heat, r);
    const SkyLight light = sky_light(sky);
    return {.sun = light.beam * seen,
            .sky = facet_sunlight(light, 0.0, open_sky(sunny)),
            .reflected = from_facets(view.sunlight, r, view.beyond, leaving.sunlight),
            .sky_longwave =
                double{warm[0]} * sky.longwave_down + sky.tilted_longwave * tilted_sky_excess(warm),
            .facet_longwave = from_facets(view.heat, r, view.beyond, leaving.longwave)};
}

double mean_radiant_temperature(std::span<const double, 6> shortwave,
                                std::span<const double, 6> longwave) {
    constexpr double absorptance = 0.7, emissivity = 0.97, vertical = 0.06, side = 0.22;
    double absorbed = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        absorbed +=
            (k < 2 ? vertical : side) * (absorptance * shortwave[k] + emissivity * longwave[k]);
    }
    return std::pow(absorbed / (emissivity * stefan_boltzmann), 0.25);
}

}  // namespace diurna
