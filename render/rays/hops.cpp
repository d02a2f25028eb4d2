#include "render/rays/hops.hpp"

#include <algorithm>

namespace diurna {

std::vector<FacetId> facets_of(const Hops& hops) {
    std::vector<std::uint32_t> seen;
    for (const Hop& hop : hops.hop) {
        if (hop.kind == Hop::Kind::facet) seen.push_back(hop.what);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<FacetId> facets;
    for (const std::uint32_t f : seen) facets.push_back(FacetId{f});
    return facets;
}

std::vector<FacetId> seen_facets(std::span<const FacetId> targets, const Hops& hops) {
    std::vector<FacetId> seen(targets.begin(), targets.end());
    const std::vector<FacetId> of_hops = facets_of(hops);
    seen.insert(seen.end(), of_hops.begin(), of_hops.end());
    return seen;
}

}  // namespace diurna
