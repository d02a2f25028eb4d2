#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermal/surface/surface_cover.hpp"

namespace diurna {

/// Water and snow on the facets with a water balance, at every instant of a field. Facets that are
/// not listed are dry.
struct CoveredFacets {
    std::vector<std::uint32_t> facet;  // ascending
    std::vector<SurfaceCover> cover;   // (instant, place in `facet`)

    bool empty() const { return facet.empty(); }
    std::span<const SurfaceCover> at(std::size_t instant) const {
        return {cover.data() + instant * facet.size(), facet.size()};
    }
    /// Interpolates linearly between two instants' rows: (place).
    std::vector<SurfaceCover> between(std::size_t a, std::size_t b, double share) const;
    /// Without the facets that are dry and bare at all instants.
    CoveredFacets kept() const;
};

/// Linear between two covers; if only one has snow, its albedo is used.
SurfaceCover between(const SurfaceCover& a, const SurfaceCover& b, double share);

/// Appends a row to `all`, which has `instants` rows; facets that only one of them lists are dry in
/// the other.
///
/// - facet, cover: ascending by facet
void add_row(std::span<const std::uint32_t> facet, std::span<const SurfaceCover> cover,
             std::size_t instants, CoveredFacets& all);

}  // namespace diurna
