#pragma once

#include <span>
#include <vector>

#include "scenes/plan/prepared.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

/// The sun as the scene sees it at an instant, refracted by its weather's air.
SunPosition sun_over(const Prepared& prepared, Instant instant);

/// More samples of facets that a shadow's edge crosses (SunFractionOptions): the same in the heat
/// balance and in pictures, which take a facet's temperature to be that of its share of the sun.
constexpr int edge_samples(int samples) { return 3 * samples; }

/// Share of each surface that the sun reaches, 0 to 1, by `samples` rays a facet; empty while the
/// sun is down. A texture's levels on a facet are lit as the facet is.
///
/// - wanted: facets of World::surfaces(); the others are reported to be in shadow. Empty: all
/// - time: of the exposure, in a scene that moves
std::vector<float> sun_on_surfaces(const Prepared& prepared, const SunPosition& sun, int samples,
                                   std::span<const FacetId> wanted = {}, float time = 0.5f);

}  // namespace diurna
