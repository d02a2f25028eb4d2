#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// Two facets that face each other across next to nothing, and how much of either lies on the
/// other.
struct TouchingFacets {
    std::uint32_t a, b;
    double area;  // [m²]
};

/// Facets of `a` that lie on facets of `b`: normals opposed to within 45°, and no further apart
/// than `gap` [m], in or out, in the middle of where they overlap. The overlap is that of b's
/// triangle, seen along a's normal, with a's: exact where they are parallel. Ordered by a, then b.
std::vector<TouchingFacets> touching_facets(const FacetSet& facets,
                                            std::span<const std::uint32_t> a,
                                            std::span<const std::uint32_t> b, double gap);

}  // namespace diurna
