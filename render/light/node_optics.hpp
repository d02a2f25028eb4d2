#pragma once

#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Optical properties of a material at one wavelength; ε + ρ + τ = 1.
struct SurfaceOptics {
    double emissivity, reflectance, transmittance;
};
SurfaceOptics optics_at(const Material& material, double wavelength_um);

/// The same at the nodes of a band.
struct NodeOptics {
    std::vector<double> emissivity, reflectance, transmittance;  // (node)
    /// (node) τ B of the room behind [W m⁻² sr⁻¹ µm⁻¹]; empty if opaque, or if the space behind has
    /// the facet's own temperature
    std::vector<double> room;
    bool transparent = false;
    double passed = 0.0;  // continues behind it (materials/matter/passed_light.hpp): heat
};

/// (material) of those with `used` set; the rest stays empty.
std::vector<NodeOptics> node_optics(const Band& band, const MaterialLibrary& materials,
                                    const std::vector<bool>& used);

/// Temperature [K] of the radiation transmitted through a facet of a transparent material: the air
/// of the room behind it (Interior), else its own.
double temperature_behind(const Material& material, double facet_temperature);

}  // namespace diurna
