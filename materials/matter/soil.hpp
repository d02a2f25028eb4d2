#pragma once

#include <string>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// Mineral or organic ground with water in its pores, for Côté and Konrad's model (2005, Can.
/// Geotech. J. 42, 443): k = (k_sat − k_dry) K_e + k_dry, k_dry = χ 10^(−η n), K_e = κ S / (1 + (κ
/// − 1) S), k_sat = k_grains^(1−n) k_water^n (k_ice^n frozen).
/// Within 0.1 to 0.25 W/mK of measurements from dry to saturated.
struct Soil {
    double porosity = 0.47;              // n, 0 to 0.95
    double saturation = 0.4;             // S, 0 to 1
    double grain_conductivity = 2.9;     // [W m⁻¹ K⁻¹]
    double grain_density = 2640.0;       // [kg m⁻³]
    double grain_heat_capacity = 890.0;  // [J kg⁻¹ K⁻¹]
    double chi = 0.75, eta = 1.2;        // of the grains' shape
    double kappa = 1.9, kappa_frozen = 0.85;
};

/// Côté and Konrad's classes: "gravel" (also crushed rock), "sand", "loam" (also silt and clay),
/// "peat".
Soil soil_named(const std::string& name);
std::vector<std::string> soil_names();

double soil_conductivity(const Soil& soil, bool frozen);  // [W m⁻¹ K⁻¹]
/// A layer of this soil; its water, if any, freezes at 273.15 K (Freezing).
Layer soil_layer(const Soil& soil, double thickness);

/// Regolith of the moon's surface after Hayne et al. (2017, J. Geophys. Res. Planets 122, 2371),
/// cut into layers that grow downward: density 1100 to 1800 kg m⁻³ with an e-folding depth of 6 cm,
/// solid conductivity 7.4e-4 to 3.4e-3 W/mK with the density, times 1 + 2.7 (T / 350 K)³, and their
/// polynomial heat capacity.
std::vector<Layer> lunar_regolith(double thickness);

}  // namespace diurna
