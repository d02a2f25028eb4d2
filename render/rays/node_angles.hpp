#pragma once

#include <vector>

#include "materials/matter/directional_optics.hpp"
#include "materials/matter/material.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

// Optics by angle at a band's nodes, for the sum over nodes (secondary_radiance.hpp).

/// directional_optics() of the nodes; an index of refraction that does not change with wavelength
/// is evaluated once.
std::vector<DirectionalOptics> optics_at_nodes(const Material& material, const Band& band,
                                               double cosine);
/// The diffuse optics' mean over the hemisphere, node by node: midpoints.
std::vector<double> mean_diffuse_at_nodes(const Material& material, const Band& band);
/// What one of the microfacets of a rough surface mirrors, (node).
std::vector<double> facing_at_nodes(const Material& material, const Band& band, double cosine);

}  // namespace diurna
