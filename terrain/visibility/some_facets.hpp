#pragma once

#include <cstdint>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/copies.hpp"
#include "terrain/visibility/facet_motion.hpp"

namespace diurna {

/// Some of a scene's facets, with their own vertices, where they are in the scene, in its copies
/// and on their way. Their numbers are others.
struct SomeFacets {
    FacetSet facets;
    Copies copies{};
    FacetMotion motion{};  // empty without motion
};

/// - wanted: (facet) 1
/// - motion: of the scene's vertices; empty without motion
SomeFacets some_facets(const FacetSet& facets, std::span<const std::uint8_t> wanted,
                       const Copies& copies, const FacetMotion& motion);

}  // namespace diurna
