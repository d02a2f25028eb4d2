#pragma once

#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// What a material does to light of one wavelength; ε + ρ + τ = 1.
struct SurfaceOptics {
    double emissivity, reflectance, transmittance;
};
SurfaceOptics optics_at(const Material& material, double wavelength_um);

/// The same at the nodes of a band.
struct NodeOptics {
    std::vector<double> emissivity, reflectance, transmittance;  // (node)
    /// (node) τ B of the room behind [W m⁻² sr⁻¹ µm⁻¹]; empty where nothing shines through, or
    /// where what is behind is as warm as the facet itself
    std::vector<double> room;
    bool transparent = false;
    double passed = 0.0;  // goes on behind it (materials/matter/passed_light.hpp): heat
};

/// (material) of those with `used` set; the rest stays empty.
std::vector<NodeOptics> node_optics(const Band& band, const MaterialLibrary& materials,
                                    const std::vector<bool>& used);

/// Temperature [K] of what shines through a facet of a transparent material: the air of the room
/// behind it (Interior), else its own.
double temperature_behind(const Material& material, double facet_temperature);

}  // namespace diurna
