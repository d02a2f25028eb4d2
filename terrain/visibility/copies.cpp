#include "terrain/visibility/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "materials/base/error.hpp"

namespace diurna {

Copies::Copies(std::vector<Copy> all) : all_(std::move(all)) {
    constexpr std::uint64_t most = first_number - 1;
    std::uint64_t facets = 0;
    begin_.push_back(0);
    for (const Copy& copy : all_) {
        facets += copy.facets;
        begin_.push_back(static_cast<std::uint32_t>(std::min(facets, most)));
    }
    if (facets >= most) {
        throw InputError(
            "copies",
            fmt::format("found {} facets in all copies, expected fewer than {}", facets, most));
    }
}

Copies::Place Copies::found(std::uint32_t k) const {
    assert(!begin_.empty() && k < begin_.back());
    const auto after = std::upper_bound(begin_.begin(), begin_.end(), k);
    const auto copy = static_cast<std::uint32_t>(after - begin_.begin()) - 1;
    return {all_[copy].first + (k - begin_[copy]), copy};
}

Eigen::AlignedBox3d Copies::box(const FacetSet& facets, std::size_t copy) const {
    const Copy& c = all_[copy];
    Eigen::AlignedBox3d box;
    for (std::uint32_t f = c.first; f < c.first + c.facets; ++f) {
        for (const std::uint32_t v : facets.corner[f]) {
            box.extend(c.pose * facets.vertex[v].cast<double>());
        }
    }
    return box;
}

FacetSet in_place(const FacetSet& facets, const Copy& copy) {
    FacetSet placed;
    for (std::uint32_t f = copy.first; f < copy.first + copy.facets; ++f) {
        const auto first = static_cast<std::uint32_t>(placed.vertex.size());
        for (const std::uint32_t v : facets.corner[f]) {
            placed.vertex.push_back((copy.pose * facets.vertex[v].cast<double>()).cast<float>());
        }
        placed.corner.push_back({first, first + 1, first + 2});
        placed.centroid.push_back((copy.pose * facets.centroid[f].cast<double>()).cast<float>());
        placed.normal.push_back(
            (copy.pose.linear() * facets.normal[f].cast<double>()).normalized().cast<float>());
        placed.area.push_back(facets.area[f]);
        placed.material.push_back(facets.material[f]);
        placed.object.push_back(copy.object);
    }
    return placed;
}

}  // namespace diurna
