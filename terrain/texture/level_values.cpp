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
            const SurfacesOfFacet source = levels_.surfaces_of(FacetId{solid_.facet[k]});
            of_levels.facet.push_back(number(source[0]));
            of_levels.factor.push_back(solid_.factor[k] * levels_.share[index(source[0])]);
            for (std::uint32_t level = 1; level < source.count; ++level) {
                const SurfaceId copy = source[level];
                copies_.emplace_back(number(copy), solid_.factor[k] * levels_.share[index(copy)]);
            }
        }
        std::sort(copies_.begin(), copies_.end());
        for (const auto& [source, factor] : copies_) {
            of_levels.facet.push_back(source);
            of_levels.factor.push_back(factor);
        }
        of_levels.row.push_back(static_cast<std::uint32_t>(of_levels.facet.size()));
    }
    /// The rows, of exactly their size.
    ViewFactors taken() {
        of_levels.facet.shrink_to_fit();
        of_levels.factor.shrink_to_fit();
        return std::move(of_levels);
    }

 private:
    ViewFactors of_levels{};
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
    const auto expanded = [&](const auto& values) {
        return values.empty() ? values : on_surfaces(texture_levels, values);
    };
    FacetViews all{.sky = expanded(solid.sky),
                   .below = expanded(solid.below),
                   .others = {},
                   .hidden = expanded(solid.hidden),
                   .rays = expanded(solid.rays),
                   .shares = expanded(solid.shares)};
    if (solid.others.row.empty()) return all;
    RowsOverLevels rows(texture_levels, solid.others, texture_levels.origin.size());
    for (const std::uint32_t f : texture_levels.origin) rows.append(f);
    all.others = rows.taken();
    return all;
}

ViewFactors levels_seen(const TextureLevels& texture_levels, const ViewFactors& solid) {
    const std::size_t n = solid.row.size() - 1;
    RowsOverLevels rows(texture_levels, solid, n);
    for (std::size_t f = 0; f < n; ++f) rows.append(f);
    return rows.taken();
}

}  // namespace diurna
