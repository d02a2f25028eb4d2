#pragma once

#include <span>
#include <vector>

#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// Expands values of solid facets to all facets; rows (instant, facet) one after the other.
std::vector<float> for_all_levels(const TextureLevels& texture_levels,
                                  std::span<const float> solid);

/// Views of all facets: copies have the views of their original, and every facet sees each texture
/// level of its surroundings by its share.
FacetViews for_all_levels(const TextureLevels& texture_levels, const FacetViews& solid);

/// Expands rows over solid facets to all facets: each of a facet's levels by its share.
ViewFactors levels_seen(const TextureLevels& texture_levels, const ViewFactors& solid);

}  // namespace diurna
