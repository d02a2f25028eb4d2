#include "render/view/pixel_heat.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

/// Facets at each vertex, in compressed rows.
struct AtVertex {
    std::vector<std::uint32_t> row, facet;

    AtVertex(const FacetSet& facets, std::size_t known) : row(facets.vertex.size() + 1, 0) {
        for (std::size_t f = 0; f < known; ++f) {
            for (const std::uint32_t v : facets.corner[f]) ++row[v + 1];
        }
        for (std::size_t v = 1; v < row.size(); ++v) row[v] += row[v - 1];
        facet.resize(row.back());
        std::vector<std::uint32_t> next(row.begin(), row.end() - 1);
        for (std::size_t f = 0; f < known; ++f) {
            for (const std::uint32_t v : facets.corner[f]) {
                facet[next[v]++] = static_cast<std::uint32_t>(f);
            }
        }
    }
};

/// Sums of a straight line through points, and the range of what they have.
struct Line {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    double low = 1e30, high = -1e30;

    void add(double share, double kelvins) {
        n += 1.0;
        x += share;
        y += kelvins;
        xx += share * share;
        xy += share * kelvins;
        low = std::min(low, kelvins);
        high = std::max(high, kelvins);
    }
    /// Through (share, kelvins), ends at 0 and 1 within the range.
    double slope(double share, double kelvins) const {
        const double spread = n * xx - x * x;
        if (!(spread > 1e-4 * n * n)) return 0.0;
        double slope = std::max(0.0, (n * xy - x * y) / spread);
        if (share < 1.0) slope = std::min(slope, (high - kelvins) / (1.0 - share));
        if (share > 0.0) slope = std::min(slope, (kelvins - low) / share);
        return slope;
    }
};

}  // namespace

std::vector<float> kelvins_of_sun(const FacetSet& facets, std::span<const std::uint8_t> crossed,
                                  std::span<const float> share,
                                  std::span<const float> temperature) {
    constexpr float one_plane = 0.985f;  // cosine of 10°
    const AtVertex at_vertex(facets, crossed.size());
    std::vector<float> slope(crossed.size(), 0.0f);
    for_each_index(crossed.size(), [&](std::size_t f) {
        if (crossed[f] == 0) return;
        Line line;
        for (const std::uint32_t v : facets.corner[f]) {
            for (std::uint32_t k = at_vertex.row[v]; k < at_vertex.row[v + 1]; ++k) {
                const std::uint32_t other = at_vertex.facet[k];
                if (facets.material[other] != facets.material[f]) continue;
                if (facets.normal[other].dot(facets.normal[f]) < one_plane) continue;
                line.add(double{share[other]}, double{temperature[other]});
            }
        }
        slope[f] = static_cast<float>(line.slope(double{share[f]}, double{temperature[f]}));
    });
    return slope;
}

void set_pixel_heat(const View& view, const SunOverFacets& sun, std::span<const float> temperature,
                    const TextureLevels* levels, PixelSun& pixels) {
    if (pixels.sighting.empty()) return;
    const std::vector<float> kelvins =
        kelvins_of_sun(sun.facets, pixels.crossed, sun.fraction, temperature);
    pixels.warmer.resize(pixels.sighting.size());
    for (std::size_t e = 0; e < pixels.warmer.size(); ++e) {
        const std::size_t facet = index(view.facet[view.sighting[pixels.sighting[e]].target]);
        const std::size_t place =
            levels == nullptr || levels->empty() ? facet : levels->origin[facet];
        pixels.warmer[e] = kelvins[place] * (pixels.share[e] - sun.fraction[facet]);
    }
}

}  // namespace diurna
