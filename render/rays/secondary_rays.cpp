#include "render/rays/secondary_rays.hpp"

#include <algorithm>

namespace diurna {

std::vector<SurfaceId> surfaces_of(const SecondaryRays& secondary_rays) {
    std::vector<SurfaceId> seen;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (secondary.kind == SecondaryRay::Kind::facet) seen.push_back(secondary.surface());
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    return seen;
}

std::vector<SurfaceId> seen_surfaces(std::span<const SurfaceId> targets,
                                     const SecondaryRays& secondary_rays) {
    std::vector<SurfaceId> seen(targets.begin(), targets.end());
    const std::vector<SurfaceId> of_secondary_rays = surfaces_of(secondary_rays);
    seen.insert(seen.end(), of_secondary_rays.begin(), of_secondary_rays.end());
    return seen;
}

}  // namespace diurna
