#include "materials/matter/soil.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double water_conductivity = 0.60, ice_conductivity = 2.24;  // [W m⁻¹ K⁻¹]
constexpr double water_density = 1000.0;
constexpr double water_heat_capacity = 4180.0, ice_heat_capacity = 2100.0;

}  // namespace

std::vector<std::string> soil_names() { return {"gravel", "sand", "loam", "peat"}; }

Soil soil_named(const std::string& name) {
    if (name == "gravel") {
        return {.porosity = 0.30, .chi = 1.70, .eta = 1.80, .kappa = 4.6, .kappa_frozen = 1.7};
    }
    if (name == "sand") {
        // Quartz carries more than loam's mixture.
        return {.porosity = 0.40,
                .grain_conductivity = 4.5,
                .grain_heat_capacity = 800.0,
                .kappa = 3.55,
                .kappa_frozen = 0.95};
    }
    if (name == "peat") {
        return {.porosity = 0.85,
                .grain_conductivity = 0.25,
                .grain_density = 1300.0,
                .grain_heat_capacity = 1920.0,
                .chi = 0.30,
                .eta = 0.87,
                .kappa = 0.60,
                .kappa_frozen = 0.25};
    }
    return {};
}

double soil_conductivity(const Soil& soil, bool frozen) {
    const double n = soil.porosity, s = soil.saturation;
    const double dry = soil.chi * std::pow(10.0, -soil.eta * n);
    const double pores = frozen ? ice_conductivity : water_conductivity;
    const double saturated = std::pow(soil.grain_conductivity, 1.0 - n) * std::pow(pores, n);
    const double kappa = frozen ? soil.kappa_frozen : soil.kappa;
    const double kersten = kappa * s / (1.0 + (kappa - 1.0) * s);
    return dry + (saturated - dry) * kersten;
}

Layer soil_layer(const Soil& soil, double thickness) {
    const double dry = soil.grain_density * (1.0 - soil.porosity);
    const double water = water_density * soil.porosity * soil.saturation;
    const double density = dry + water;
    const auto mixed = [&](double of_water) {
        return (dry * soil.grain_heat_capacity + water * of_water) / density;
    };
    Layer layer{.thickness = thickness,
                .conductivity = soil_conductivity(soil, false),
                .density = density,
                .heat_capacity = mixed(water_heat_capacity)};
    if (water > 0.0) {
        layer.law = Freezing{.water = water,
                             .frozen_conductivity = soil_conductivity(soil, true),
                             .frozen_heat_capacity = mixed(ice_heat_capacity)};
    }
    return layer;
}

std::vector<Layer> lunar_regolith(double thickness) {
    constexpr double surface = 1100.0, deep = 1800.0, folding = 0.06;  // kg/m³, m
    constexpr double least = 7.4e-4, most = 3.4e-3, chi = 2.7;
    const HeatPolynomial heat{-3.6125, 2.7431, 2.3616e-3, -1.2340e-5, 8.9093e-9};
    std::vector<Layer> layers;
    double top = 0.0;
    while (top < thickness * (1.0 - 1e-12)) {
        const double width = std::min(0.002 + 0.08 * top, thickness - top);
        // Mean density of the layer, so that no mass is lost by the cut.
        const double density =
            deep - (deep - surface) * folding / width *
                       (std::exp(-top / folding) - std::exp(-(top + width) / folding));
        const double solid = most - (most - least) * (deep - density) / (deep - surface);
        layers.push_back({.thickness = width,
                          .conductivity = solid,
                          .density = density,
                          .heat_capacity = 600.0,  // at 250 K, for who takes constants
                          .law = Radiating{.cubic = chi / (350.0 * 350.0 * 350.0), .heat = heat}});
        top += width;
    }
    return layers;
}

}  // namespace diurna
