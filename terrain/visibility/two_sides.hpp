#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

// A sheet has two sides, each a facet of its own: same corners, the one counterclockwise from
// here, the other from there. Rays meet the side that looks at them; sky, sun, neighbours are each
// side's own.

/// Appends the other sides of some facets, in their order.
///
/// material  (front) of its back
void append_backs(FacetSet& facets, std::span<const std::uint32_t> front,
                  std::span<const MaterialId> material);

/// (facet) the number of its other side, index(no_facet) where it has none; empty where no facet
/// of an object has one. Where a texture has made copies of a side: the first of them.
std::vector<std::uint32_t> other_sides(const FacetSet& facets);

}  // namespace diurna
