#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// What a material does to light at the nodes of a band; ε + ρ + τ = 1 at each.
struct NodeOptics {
    std::vector<double> emissivity, reflectance, transmittance;  // (node)
    /// (node) τ B of the room behind [W m⁻² sr⁻¹ µm⁻¹]; empty where nothing shines through, or
    /// where what is behind is as warm as the facet itself
    std::vector<double> room;
    bool transparent = false;
};

/// (material) of those with `used` set; the rest stays empty.
std::vector<NodeOptics> node_optics(const Band& band, const MaterialLibrary& materials,
                                    const std::vector<bool>& used);

}  // namespace diurna
