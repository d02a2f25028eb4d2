#pragma once

#include <span>
#include <vector>

#include "materials/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility.hpp"
#include "thermal/irradiance.hpp"

namespace diurna {

/// Broadband optics of every facet.
struct FacetOptics {
    std::vector<float> albedo, emissivity;  // (facet)
};
FacetOptics facet_optics(const FacetSet& facets, const MaterialLibrary& materials);

/// Sunlight on every facet at one instant [W m⁻²]: beam and sky (facet_sunlight) and what other
/// facets reflect, two bounces deep; what is left of the third is below albedo³ of the seen share.
/// Ground below the scene's edge reflects the horizontal global sun as the facet itself would.
///
/// fraction  (facet) share in the sun; empty: nothing casts a shadow
void incident_sunlight(const FacetSet& facets, const SkyView& view, const FacetOptics& optics,
                       const SkyState& sky, std::span<const float> fraction, bool exchange,
                       std::span<float> incident);

/// Longwave from other facets beyond what the sky they hide would send, D = L_in − L_sky [W m⁻²]:
/// neighbours emit ε σ T⁴ and reflect the rest of what reaches them (`excess` as it was). Zero,
/// whatever the emissivities, where ground and sky are equally warm. `excess` is replaced.
///
/// returns  the largest change of a facet's excess [W m⁻²]
double terrain_longwave(const SkyView& view, const FacetOptics& optics, double sky_longwave,
                        std::span<const float> temperature, std::span<float> excess);

}  // namespace diurna
