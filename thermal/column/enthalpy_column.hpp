#pragma once

#include <vector>

namespace diurna {

// A column's nodes and links as plain numbers, for loops that step many columns in parallel
// (thermal/kernels/enthalpy_kernel.hpp). States and laws as in NonlinearColumn, without regolith.

struct EnthalpyNode {
    double zero = 0.0;                  // [K] where u is 0
    double thawed = 0.0, frozen = 0.0;  // [J m⁻² K⁻¹]
    double latent = 0.0;                // [J m⁻²] between u = 0 and 1
    double held = 0.0;                  // part of `latent` retained in snow's pores
    bool drains = false;                // snow
};
/// From node i to i + 1.
struct EnthalpyLink {
    double per_width = 0.0;             // [m⁻¹]
    double frozen = 0.0, thawed = 0.0;  // [W m⁻¹ K⁻¹]
};
struct EnthalpyColumn {
    std::vector<EnthalpyNode> node;
    std::vector<EnthalpyLink> link;
    /// Flux into the last node: below_flux + below_conductance (below_temperature − T), or along a
    /// link to a fixed temperature.
    double below_flux = 0.0, below_conductance = 0.0, below_temperature = 0.0;
    bool below_is_link = false;
    EnthalpyLink below_link{};
};

}  // namespace diurna
