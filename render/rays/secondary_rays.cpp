#include "render/rays/secondary_rays.hpp"

#include <algorithm>

namespace diurna {

std::vector<FacetId> facets_of(const SecondaryRays& secondary_rays) {
    std::vector<std::uint32_t> seen;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (secondary.kind == SecondaryRay::Kind::facet) seen.push_back(secondary.what);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<FacetId> facets;
    for (const std::uint32_t f : seen) facets.push_back(FacetId{f});
    return facets;
}

std::vector<FacetId> seen_facets(std::span<const FacetId> targets,
                                 const SecondaryRays& secondary_rays) {
    std::vector<FacetId> seen(targets.begin(), targets.end());
    const std::vector<FacetId> of_secondary_rays = facets_of(secondary_rays);
    seen.insert(seen.end(), of_secondary_rays.begin(), of_secondary_rays.end());
    return seen;
}

}  // namespace diurna
