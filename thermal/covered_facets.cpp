#include "thermal/covered_facets.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace diurna {

namespace {

/// Rows over `facet` of `field` as rows over `wanted`, which holds all of them.
std::vector<SurfaceCover> spread(std::span<const std::uint32_t> facet,
                                 std::span<const SurfaceCover> cover, std::size_t instants,
                                 std::span<const std::uint32_t> wanted) {
    std::vector<SurfaceCover> rows(instants * wanted.size());
    std::size_t place = 0;
    for (std::size_t k = 0; k < facet.size(); ++k) {
        while (wanted[place] != facet[k]) ++place;
        for (std::size_t i = 0; i < instants; ++i) {
            rows[i * wanted.size() + place] = cover[i * facet.size() + k];
        }
    }
    return rows;
}

}  // namespace

SurfaceCover between(const SurfaceCover& a, const SurfaceCover& b, double share) {
    const float white_a = a.snow > 0.0f ? a.snow_albedo : b.snow_albedo;
    const float white_b = b.snow > 0.0f ? b.snow_albedo : a.snow_albedo;
    const auto s = float(share);
    return {std::lerp(a.wet, b.wet, s), std::lerp(a.snow, b.snow, s),
            std::lerp(white_a, white_b, s)};
}

std::vector<SurfaceCover> CoveredFacets::between(std::size_t a, std::size_t b, double share) const {
    std::vector<SurfaceCover> row(facet.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
        row[k] = diurna::between(at(a)[k], at(b)[k], share);
    }
    return row;
}

CoveredFacets CoveredFacets::kept() const {
    std::vector<std::size_t> place;
    const std::size_t instants = empty() ? 0 : cover.size() / facet.size();
    for (std::size_t k = 0; k < facet.size(); ++k) {
        bool any = false;
        for (std::size_t i = 0; i < instants && !any; ++i) any = at(i)[k].any();
        if (any) place.push_back(k);
    }
    CoveredFacets some;
    for (const std::size_t k : place) some.facet.push_back(facet[k]);
    for (std::size_t i = 0; i < instants; ++i) {
        for (const std::size_t k : place) some.cover.push_back(at(i)[k]);
    }
    return some;
}

void add_row(std::span<const std::uint32_t> facet, std::span<const SurfaceCover> cover,
             std::size_t instants, CoveredFacets& all) {
    std::vector<std::uint32_t> both;
    std::set_union(all.facet.begin(), all.facet.end(), facet.begin(), facet.end(),
                   std::back_inserter(both));
    if (both != all.facet) {
        all.cover = spread(all.facet, all.cover, instants, both);
        all.facet = std::move(both);
    }
    const std::vector<SurfaceCover> row = spread(facet, cover, 1, all.facet);
    all.cover.insert(all.cover.end(), row.begin(), row.end());
}

}  // namespace diurna
