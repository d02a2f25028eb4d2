#include "terrain/visibility/some_facets.hpp"

#include <cassert>
#include <map>
#include <utility>
#include <vector>

namespace diurna {

namespace {

/// Copies of what is left of what they copy; none where nothing is.
///
/// - before: (facet + 1) wanted facets before each
Copies copies_of(const Copies& copies, std::span<const std::uint32_t> before) {
    std::vector<Copy> left;
    for (std::size_t c = 0; c < copies.size(); ++c) {
        Copy copy = copies[c];
        const std::uint32_t first = before[copy.first], last = before[copy.first + copy.facets];
        if (first == last) continue;
        copy.first = first;
        copy.facets = last - first;
        left.push_back(copy);
    }
    return Copies(std::move(left));
}

}  // namespace

SomeFacets some_facets(const FacetSet& facets, std::span<const std::uint8_t> wanted,
                       const Copies& copies, const FacetMotion& motion) {
    assert(wanted.size() == facets.size());
    SomeFacets some;
    std::map<std::uint32_t, std::uint32_t> place;  // of a vertex
    std::vector<std::uint32_t> before(facets.size() + 1, 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        before[f + 1] = before[f] + (wanted[f] != 0 ? 1 : 0);
        if (wanted[f] == 0) continue;
        auto& corner = some.facets.corner.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = facets.corner[f][k];
            const auto [known, is_new] =
                place.try_emplace(v, static_cast<std::uint32_t>(place.size()));
            corner[k] = known->second;
            if (!is_new) continue;
            some.facets.vertex.push_back(facets.vertex[v]);
            if (motion.after.empty()) continue;
            some.motion.before.push_back(motion.before[v]);
            some.motion.after.push_back(motion.after[v]);
        }
        some.facets.centroid.push_back(facets.centroid[f]);
        some.facets.normal.push_back(facets.normal[f]);
        some.facets.area.push_back(facets.area[f]);
        some.facets.material.push_back(facets.material[f]);
        some.facets.object.push_back(facets.object[f]);
    }
    some.copies = copies_of(copies, before);
    return some;
}

}  // namespace diurna
