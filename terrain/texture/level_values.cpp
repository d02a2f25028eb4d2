#include "terrain/texture/level_values.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

/// Rows in which every solid facet is its levels.
class RowsOverLevels {
 public:
    RowsOverLevels(const TextureLevels& levels, const ViewFactors& solid, std::size_t rows)
        : levels_(levels), solid_(solid) {
        of_levels.row.reserve(rows + 1);
        of_levels.row.push_back(0);
    }
    /// One more, of a row of the solid ones.
    void append(std::size_t row) {
        copies_.clear();
        for (std::uint32_t k = solid_.row[row]; k < solid_.row[row + 1]; ++k) {
            const std::size_t source = index(solid_.facet[k]);
            const TextureLevels::OfFacet& of_facet = levels_.of_facet[source];
            of_levels.facet.push_back(solid_.facet[k]);
            of_levels.factor.push_back(solid_.factor[k] * levels_.share[source]);
            for (std::uint32_t c = 0; c + 1 < of_facet.levels; ++c) {
                const std::uint32_t copy = of_facet.first_copy + c;
                copies_.emplace_back(copy, solid_.factor[k] * levels_.share[copy]);
            }
        }
        std::sort(copies_.begin(), copies_.end());
        for (const auto& [source, factor] : copies_) {
            of_levels.facet.push_back(FacetId{source});
            of_levels.factor.push_back(factor);
        }
        of_levels.row.push_back(static_cast<std::uint32_t>(of_levels.facet.size()));
    }
    ViewFactors of_levels{};

 private:
    const TextureLevels& levels_;
    const ViewFactors& solid_;
    std::vector<std::pair<std::uint32_t, float>> copies_{};
};

}  // namespace

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
    if (solid.others.row.empty()) return all;
    RowsOverLevels rows(texture_levels, solid.others, n);
    for (const std::uint32_t f : texture_levels.origin) rows.append(f);
    all.others = std::move(rows.of_levels);
    return all;
}

ViewFactors levels_seen(const TextureLevels& texture_levels, const ViewFactors& solid) {
    const std::size_t n = solid.row.size() - 1;
    RowsOverLevels rows(texture_levels, solid, n);
    for (std::size_t f = 0; f < n; ++f) rows.append(f);
    return std::move(rows.of_levels);
}

}  // namespace diurna
