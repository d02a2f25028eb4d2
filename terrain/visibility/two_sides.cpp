#include "terrain/visibility/two_sides.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace diurna {

namespace {

/// Corners in the order of going round, the least number first.
std::array<std::uint32_t, 3> way_round(std::array<std::uint32_t, 3> corner) {
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    return corner;
}

}  // namespace

void append_backs(FacetSet& facets, std::span<const std::uint32_t> front,
                  std::span<const MaterialId> material) {
    assert(front.size() == material.size());
    for (std::size_t i = 0; i < front.size(); ++i) {
        const std::uint32_t f = front[i];
        const std::array<std::uint32_t, 3> corner = facets.corner[f];
        const Eigen::Vector3f centroid = facets.centroid[f], normal = facets.normal[f];
        facets.corner.push_back({corner[0], corner[2], corner[1]});
        facets.centroid.push_back(centroid);
        facets.normal.push_back(-normal);
        facets.area.push_back(float{facets.area[f]});
        facets.material.push_back(material[i]);
        facets.object.push_back(ObjectId{facets.object[f]});
    }
}

std::vector<std::uint32_t> other_sides(const FacetSet& facets) {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> known;
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        if (facets.object[f] != ObjectId{0}) known.emplace_back(way_round(facets.corner[f]), f);
    }
    std::sort(known.begin(), known.end());
    std::vector<std::uint32_t> other;
    for (const auto& [corner, f] : known) {
        const std::pair turned{std::array{corner[0], corner[2], corner[1]}, 0u};
        const auto found = std::lower_bound(known.begin(), known.end(), turned);
        if (found == known.end() || found->first != turned.first) continue;
        if (other.empty()) other.assign(facets.size(), index(no_facet));
        other[f] = found->second;
    }
    return other;
}

}  // namespace diurna
