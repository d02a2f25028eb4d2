#pragma once

#include "thermal/surface/surface_conditions.hpp"

namespace diurna {

/// A surface that covers a share of a facet: bare ground, leaves, or the soil between them.
struct SurfacePart {
    double cover = 1.0;     // share of the facet
    double solar = 0.0;     // [W m⁻²] absorbed, per unit facet
    double internal = 0.0;  // [W m⁻²] per unit facet
    double resistance = 0.0, wetness = 0.0;
    double shelter = 0.0;     // share of it that leaves shelter from the open air's film
    double soil_film = 0.0;   // [W m⁻² K⁻¹] of the sheltered share
    double least_film = 0.0;  // [W m⁻² K⁻¹] of leaves, minimum
    double leaf_film = 0.0;   // [W m⁻² K⁻¹] of all leaves' boundary layers, per unit facet
};
/// The whole ground of a facet.
SurfacePart whole_ground(const SurfaceConditions& conditions);

/// Its terms at a temperature, towards it, per unit facet [W m⁻²]; `flux` is the sum of these and
/// the internal heat, `slope` d(flux)/dT.
struct PartTerms {
    double solar, longwave_in, longwave_out, sensible, latent, wet_latent, melt, flux, slope;
};
PartTerms part_terms(const SurfaceConditions& conditions, const SurfacePart& part,
                     double temperature);

/// Adds a part's terms to those of the whole surface.
void add(const PartTerms& part, SurfaceTerms& terms);

}  // namespace diurna
