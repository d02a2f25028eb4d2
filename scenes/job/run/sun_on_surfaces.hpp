#pragma once

#include <span>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

/// The apparent sun at an instant, refracted by the weather's air.
SunPosition sun_over(const Prepared& prepared, Instant instant);

/// Additional samples of facets that a shadow's edge crosses (SunFractionOptions): the same
/// in the heat balance and in pictures, where a facet's temperature is that of its sunlit
/// share.
constexpr int edge_samples(int samples) { return 3 * samples; }

/// Sunlit share of each surface, 0 to 1, by `samples` rays a facet; empty while the sun is down. A
/// texture's levels on a facet have the facet's share.
///
/// - wanted: facets of World::surfaces(); the others count as in shadow. Empty: all
/// - time: of the exposure, in a scene with motion
std::vector<float> sun_on_surfaces(const Prepared& prepared, const SunPosition& sun, int samples,
                                   std::span<const SurfaceId> wanted = {}, float time = 0.5f);

}  // namespace diurna
