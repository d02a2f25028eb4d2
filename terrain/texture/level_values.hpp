#pragma once

#include <span>
#include <vector>

#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// (surface) values of the facets on which they lie; without textures `solid` itself.
template <class T>
std::vector<T> on_surfaces(const TextureLevels& texture_levels, std::vector<T> solid) {
    solid.reserve(texture_levels.origin.size());
    for (std::size_t s = solid.size(); s < texture_levels.origin.size(); ++s) {
        solid.push_back(solid[texture_levels.origin[s]]);
    }
    return solid;
}

/// Expands values of facets to all surfaces; rows (instant, facet) one after the other.
std::vector<float> for_all_levels(const TextureLevels& texture_levels,
                                  std::span<const float> solid);

/// Views of all surfaces: each has the view of its facet, and sees each texture level of its
/// surroundings by its share.
FacetViews for_all_levels(const TextureLevels& texture_levels, const FacetViews& solid);

/// Expands rows over facets to all surfaces: each of a facet's levels by its share.
ViewFactors levels_seen(const TextureLevels& texture_levels, const ViewFactors& solid);

}  // namespace diurna
