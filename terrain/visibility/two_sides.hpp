#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

// A sheet has two sides, each a separate facet: same corners, one counterclockwise seen from the
// front, the other from the back. Rays meet the side that faces them; sky, sun and neighbours are
// computed for each side.

/// Appends the other sides of some facets, in their order.
///
/// material  (front) material of its back
void append_backs(FacetSet& facets, std::span<const std::uint32_t> front,
                  std::span<const MaterialId> material);

/// (facet) the number of its other side, index(no_facet) without one; empty if no facet of an
/// object has one. If a texture has split a side: the first of its facets.
std::vector<std::uint32_t> other_sides(const FacetSet& facets);

}  // namespace diurna
