#include "scenes/products/report/material_figures.hpp"

#include <cmath>
#include <numbers>

#include "materials/matter/net_optics.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr double room_temperature = 300.0, day_seconds = 86400.0;

/// What is neither sent back nor let through, weighted by Planck's law.
double emissivity_in(const Material& material, double from_um, double to_um) {
    const Band band = flat_band("", from_um, to_um, material.reflectance.wavelength_um);
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        const double um = band.node_um[i];
        sum += band.weight[i] * planck(um, room_temperature) *
               (1.0 - material.reflectance.at(um) - material.transmittance.at(um));
    }
    return sum / band_radiance(band, room_temperature);
}

double reflectance_in(const Material& material, double from_um, double to_um) {
    return integral(material.reflectance, from_um, to_um) / (to_um - from_um);
}

}  // namespace

MaterialFigures material_figures(const Material& given) {
    Material material = given;
    take_strips(material);  // a net's, as its albedo and emissivity are
    const Layer& top = material.thermal.layers.front();
    const double capacity = top.density * top.heat_capacity;
    const double diffusivity = top.conductivity / capacity;
    return {.albedo = material.thermal.albedo,
            .transmittance = material.thermal.solar_transmittance,
            .emissivity = material.thermal.emissivity,
            .mwir = emissivity_in(material, 3.0, 5.0),
            .lwir = emissivity_in(material, 8.0, 12.0),
            .wide = emissivity_in(material, 8.0, 14.0),
            .diffusivity = diffusivity,
            .inertia = std::sqrt(top.conductivity * capacity),
            .day_depth = std::sqrt(diffusivity * day_seconds / std::numbers::pi),
            .visible = {reflectance_in(material, 0.6, 0.7), reflectance_in(material, 0.5, 0.6),
                        reflectance_in(material, 0.4, 0.5)}};
}

}  // namespace diurna
