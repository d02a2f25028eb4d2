#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermal/surface/surface_cover.hpp"

namespace diurna {

/// What lies on the facets whose water is followed, at every instant of a field. Facets that are
/// not named are dry.
struct CoveredFacets {
    std::vector<std::uint32_t> facet;  // ascending
    std::vector<SurfaceCover> cover;   // (instant, place in `facet`)

    bool empty() const { return facet.empty(); }
    std::span<const SurfaceCover> at(std::size_t instant) const {
        return {cover.data() + instant * facet.size(), facet.size()};
    }
    /// Two instants' rows, straight in between: (place).
    std::vector<SurfaceCover> between(std::size_t a, std::size_t b, double share) const;
    /// Without the facets that are dry and bare throughout.
    CoveredFacets kept() const;
};

/// Straight between two covers; the snow of one that has none is as white as the other's.
SurfaceCover between(const SurfaceCover& a, const SurfaceCover& b, double share);

/// Adds a row to `all`, which has `instants` of them; either may name facets that the other does
/// not: they are dry there.
///
/// - facet: ascending; cover: likewise
void add_row(std::span<const std::uint32_t> facet, std::span<const SurfaceCover> cover,
             std::size_t instants, CoveredFacets& all);

}  // namespace diurna
