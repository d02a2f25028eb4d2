#pragma once

#include <vector>

#include "materials/matter/directional_optics.hpp"
#include "materials/matter/material.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

// Optics by angle at a band's nodes, for the sum over nodes (secondary_radiance.hpp).

/// directional_optics() of the nodes; an index of refraction that is constant over wavelength is
/// evaluated once.
std::vector<DirectionalOptics> optics_at_nodes(const Material& material, const Band& band,
                                               double cosine);
/// The diffuse optics' mean over the hemisphere, node by node: midpoints.
std::vector<double> mean_diffuse_at_nodes(const Material& material, const Band& band);
/// Reflectance of one microfacet of a rough surface, (node).
std::vector<double> facing_at_nodes(const Material& material, const Band& band, double cosine);

}  // namespace diurna
