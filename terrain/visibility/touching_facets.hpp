#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// Two facets that face each other at almost no distance, and their area of
/// overlap.
struct TouchingFacets {
    std::uint32_t a, b;
    double area;  // [m²]
};

/// Facets of `a` on facets of `b`: normals opposed to within 45°, and at most `gap` [m] apart, in
/// or out, in the middle of the overlap. The overlap is that of b's triangle, projected along a's
/// normal, with a's: exact if they are parallel. Ordered by a, then b.
std::vector<TouchingFacets> touching_facets(const FacetSet& facets,
                                            std::span<const std::uint32_t> a,
                                            std::span<const std::uint32_t> b, double gap);

}  // namespace diurna
