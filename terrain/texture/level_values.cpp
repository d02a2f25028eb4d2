#include "terrain/texture/level_values.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "materials/base/parallel.hpp"

namespace diurna {

std::vector<float> for_all_levels(const TextureLevels& texture_levels,
                                  std::span<const float> solid) {
    if (solid.empty()) return {};
    const std::size_t rows = solid.size() / texture_levels.solid, n = texture_levels.origin.size();
    assert(rows * texture_levels.solid == solid.size());
    std::vector<float> all(rows * n);
    for_each_index(
        rows,
        [&](std::size_t i) {
            for (std::size_t f = 0; f < n; ++f) {
                all[i * n + f] = solid[i * texture_levels.solid + texture_levels.origin[f]];
            }
        },
        1);
    return all;
}

FacetViews for_all_levels(const TextureLevels& texture_levels, const FacetViews& solid) {
    FacetViews all{.sky = for_all_levels(texture_levels, solid.sky),
                   .below = for_all_levels(texture_levels, solid.below),
                   .others = {},
                   .hidden = for_all_levels(texture_levels, solid.hidden)};
    const std::size_t n = texture_levels.origin.size();
    if (!solid.rays.empty()) {
        for (const std::uint32_t f : texture_levels.origin) all.rays.push_back(solid.rays[f]);
    }
    if (!solid.shares.empty()) {
        for (const std::uint32_t f : texture_levels.origin) all.shares.push_back(solid.shares[f]);
    }
    const ViewFactors& from = solid.others;
    if (from.row.empty()) return all;
    ViewFactors& to = all.others;
    to.row.reserve(n + 1);
    to.row.push_back(0);
    std::vector<std::pair<std::uint32_t, float>> copies;
    for (std::size_t f = 0; f < n; ++f) {
        const std::size_t o = texture_levels.origin[f];
        copies.clear();
        for (std::uint32_t k = from.row[o]; k < from.row[o + 1]; ++k) {
            const std::size_t source = index(from.facet[k]);
            const TextureLevels::OfFacet& of_facet = texture_levels.of_facet[source];
            to.facet.push_back(from.facet[k]);
            to.factor.push_back(from.factor[k] * texture_levels.share[source]);
            for (std::uint32_t c = 0; c + 1 < of_facet.levels; ++c) {
                copies.emplace_back(of_facet.first_copy + c,
                                    from.factor[k] * texture_levels.share[of_facet.first_copy + c]);
            }
        }
        std::sort(copies.begin(), copies.end());
        for (const auto& [source, factor] : copies) {
            to.facet.push_back(FacetId{source});
            to.factor.push_back(factor);
        }
        to.row.push_back(static_cast<std::uint32_t>(to.facet.size()));
    }
    return all;
}

}  // namespace diurna
