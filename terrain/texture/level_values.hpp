#pragma once

#include <span>
#include <vector>

#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// Values of solid facets for all facets; rows (instant, facet) one after the other.
std::vector<float> for_all_levels(const TextureLevels& texture_levels,
                                  std::span<const float> solid);

/// What all facets see: copies as the facet in whose place they are, and every facet each of its
/// surroundings' levels by its share.
FacetViews for_all_levels(const TextureLevels& texture_levels, const FacetViews& solid);

/// Rows over solid facets as rows over all: each of a facet's levels by its share.
ViewFactors levels_seen(const TextureLevels& texture_levels, const ViewFactors& solid);

}  // namespace diurna
