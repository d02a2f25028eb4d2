#include "scenes/job/world/some_facets.hpp"

namespace diurna {

FacetSet some_facets(const FacetSet& all, std::span<const std::uint32_t> facet) {
    FacetSet part;
    for (const std::uint32_t f : facet) {
        const auto first = static_cast<std::uint32_t>(part.vertex.size());
        for (const std::uint32_t v : all.corner[f]) part.vertex.push_back(all.vertex[v]);
        part.corner.push_back({first, first + 1, first + 2});
        part.centroid.push_back(all.centroid[f]);
        part.normal.push_back(all.normal[f]);
        part.area.push_back(all.area[f]);
        part.material.push_back(all.material[f]);
        part.object.push_back(all.object[f]);
    }
    return part;
}

}  // namespace diurna
