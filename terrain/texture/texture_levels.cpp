#include "terrain/texture/texture_levels.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

/// Level of a value, 0 to the last.
double level_of(const Skin& skin, double value) {
    if (std::isnan(value)) value = skin.outside;
    return std::clamp((value - skin.low) / skin.step, 0.0, double(skin.material.size() - 1));
}

double level_at(const Skin& skin, const Eigen::Vector3d& place, const Eigen::Vector3f& normal,
                double spacing) {
    return level_of(skin,
                    texture_at(*skin.texture, texture_place(skin.frame, place, normal), spacing));
}

std::array<Eigen::Vector3d, 3> corners(const FacetSet& facets, std::size_t f) {
    const auto& [a, b, c] = facets.corner[f];
    return {facets.vertex[a].cast<double>(), facets.vertex[b].cast<double>(),
            facets.vertex[c].cast<double>()};
}

/// First and last level that occur on a facet.
std::array<std::size_t, 2> levels_on(const Skin& skin, const FacetSet& facets, std::size_t f) {
    const std::size_t last = skin.material.size() - 1;
    const auto* raster = std::get_if<RasterTexture>(skin.texture.get());
    if (raster == nullptr) return {0, last};
    std::array<Eigen::Vector2d, 3> place;
    const auto corner = corners(facets, f);
    for (std::size_t k = 0; k < 3; ++k) {
        place[k] = texture_place(skin.frame, corner[k], facets.normal[f]);
    }
    const auto [least, most] = raster->range(place);
    double low = level_of(skin, least), high = level_of(skin, most);
    for (const Eigen::Vector2d& at : place) {  // beyond the picture's edge
        const double value = raster->at(at.x(), at.y());
        if (!std::isnan(value)) continue;
        const double level = level_of(skin, value);
        low = std::min(low, level);
        high = std::max(high, level);
    }
    constexpr double rounding = 1e-6;  // values are floats
    const auto from = static_cast<std::size_t>(std::floor(low + rounding));
    return {from, std::max(from, static_cast<std::size_t>(std::ceil(high - rounding)))};
}

/// Shares of a facet's levels: means over places spread evenly over the triangle.
std::vector<double> shares_on(const Skin& skin, const FacetSet& facets, std::size_t f,
                              std::array<std::size_t, 2> levels) {
    const auto corner = corners(facets, f);
    const double side = std::sqrt(2.0 * double{facets.area[f]});
    double detail = 1.0;
    if (const auto* raster = std::get_if<RasterTexture>(skin.texture.get())) {
        detail = raster->texel();
    } else {
        detail = 0.25 * std::get<ClutterTexture>(*skin.texture).field.length();
    }
    const int n = std::clamp(static_cast<int>(std::ceil(side / detail)), 1, 8);
    const double spacing = side / n;
    std::vector<double> share(levels[1] - levels[0] + 1, 0.0);
    int count = 0;
    // The middles of n² triangles alike.
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            for (int flipped = 0; flipped < (j < n - i - 1 ? 2 : 1); ++flipped) {
                const double u = (i + (flipped ? 2.0 : 1.0) / 3.0) / n;
                const double v = (j + (flipped ? 2.0 : 1.0) / 3.0) / n;
                const Eigen::Vector3d place =
                    corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
                const double level = std::clamp(level_at(skin, place, facets.normal[f], spacing),
                                                double(levels[0]), double(levels[1])) -
                                     double(levels[0]);
                const auto below = std::min(static_cast<std::size_t>(level), share.size() - 1);
                const double part = level - double(below);
                share[below] += 1.0 - part;
                if (part > 0.0) share[below + 1] += part;
                ++count;
            }
        }
    }
    for (double& s : share) s /= count;
    return share;
}

}  // namespace

TextureLevels split_by_texture(const FacetSet& facets, std::vector<Skin> skins,
                               std::span<const std::uint16_t> skin_of) {
    assert(skin_of.size() == facets.size());
    TextureLevels made;
    made.solid = facets.size();
    if (std::all_of(skin_of.begin(), skin_of.end(), [](auto s) { return s == no_skin; }))
        return made;
    made.facets = facets;
    made.skin = std::move(skins);
    made.of_facet.resize(made.solid);
    made.origin.resize(made.solid);
    made.share.assign(made.solid, 1.0f);
    for (std::size_t f = 0; f < made.solid; ++f) made.origin[f] = static_cast<std::uint32_t>(f);

    std::vector<std::vector<double>> shares(made.solid);
    for_each_index(
        made.solid,
        [&](std::size_t f) {
            if (skin_of[f] == no_skin) return;
            const Skin& skin = made.skin[skin_of[f]];
            const auto levels = levels_on(skin, facets, f);
            made.of_facet[f] = {.skin = skin_of[f],
                                .first_level = static_cast<std::uint16_t>(levels[0]),
                                .levels = static_cast<std::uint16_t>(levels[1] - levels[0] + 1)};
            shares[f] = shares_on(skin, facets, f, levels);
        },
        256);
    for (std::size_t f = 0; f < made.solid; ++f) {
        TextureLevels::OfFacet& of_facet = made.of_facet[f];
        if (of_facet.skin == no_skin) continue;
        const Skin& skin = made.skin[of_facet.skin];
        const float area = facets.area[f];
        of_facet.first_copy = static_cast<std::uint32_t>(made.facets.size());
        made.facets.material[f] = skin.material[of_facet.first_level];
        made.facets.area[f] = static_cast<float>(shares[f][0]) * area;
        made.share[f] = static_cast<float>(shares[f][0]);
        for (std::size_t k = 1; k < of_facet.levels; ++k) {
            made.facets.corner.push_back(facets.corner[f]);
            made.facets.centroid.push_back(facets.centroid[f]);
            made.facets.normal.push_back(facets.normal[f]);
            made.facets.area.push_back(static_cast<float>(shares[f][k]) * area);
            made.facets.material.push_back(skin.material[of_facet.first_level + k]);
            made.facets.object.push_back(facets.object[f]);
            made.origin.push_back(static_cast<std::uint32_t>(f));
            made.share.push_back(static_cast<float>(shares[f][k]));
        }
    }
    return made;
}

Blend TextureLevels::at(FacetId facet, const Eigen::Vector3d& place, double spacing) const {
    const OfFacet& here = of_facet[index(facet)];
    const SurfacesOfFacet surface = surfaces_of(facet);
    if (here.levels < 2) return {surface[0], surface[0]};
    const double level = std::clamp(
        level_at(skin[here.skin], place, facets.normal[index(facet)], spacing) - here.first_level,
        0.0, double(here.levels - 1));
    const auto below = std::min(static_cast<std::uint32_t>(level), here.levels - 2u);
    return {surface[below], surface[below + 1], static_cast<float>(level - double(below))};
}

}  // namespace diurna
