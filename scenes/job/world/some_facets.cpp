#include "scenes/job/world/some_facets.hpp"

#include <algorithm>

namespace diurna {

FacetSet some_facets(const FacetSet& all, std::span<const std::uint32_t> facet) {
    std::vector<std::uint32_t> used;
    used.reserve(3 * facet.size());
    for (const std::uint32_t f : facet) {
        used.insert(used.end(), all.corner[f].begin(), all.corner[f].end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto place = [&](std::uint32_t vertex) {
        return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), vertex) -
                                          used.begin());
    };
    FacetSet part;
    part.vertex.reserve(used.size());
    for (const std::uint32_t v : used) part.vertex.push_back(all.vertex[v]);
    part.corner.reserve(facet.size());
    part.centroid.reserve(facet.size());
    part.normal.reserve(facet.size());
    part.area.reserve(facet.size());
    part.material.reserve(facet.size());
    part.object.reserve(facet.size());
    for (const std::uint32_t f : facet) {
        const auto& [a, b, c] = all.corner[f];
        part.corner.push_back({place(a), place(b), place(c)});
        part.centroid.push_back(all.centroid[f]);
        part.normal.push_back(all.normal[f]);
        part.area.push_back(all.area[f]);
        part.material.push_back(all.material[f]);
        part.object.push_back(all.object[f]);
    }
    return part;
}

}  // namespace diurna
