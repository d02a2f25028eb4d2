#include "scenes/job/run/sample_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/job/run/appearances.hpp"

namespace diurna {

namespace {

/// What the pixels around show of sky, and of ground beyond the scene's edge: of each pixel that
/// sees a part of it, the apparent temperature of the nearest that sees nothing else.
///
/// returns  (pixel) [K]
std::vector<float> sky_around(const View& view, const std::vector<float>& apparent) {
    constexpr int farthest = 4;        // [pixels]
    constexpr float unknown = 250.0f;  // [K]
    std::vector<float> sky(view.pixels(), unknown);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const auto at = [&](int column, int row) {
                return std::size_t(row) * std::size_t(view.width) + std::size_t(column);
            };
            const std::size_t p = at(x, y);
            if (view.sky[p] <= 0.0f) continue;
            int nearest = farthest * farthest + 1;
            for (int j = std::max(0, y - farthest); j <= std::min(view.height - 1, y + farthest);
                 ++j) {
                for (int i = std::max(0, x - farthest); i <= std::min(view.width - 1, x + farthest);
                     ++i) {
                    const int apart = (i - x) * (i - x) + (j - y) * (j - y);
                    if (apart >= nearest || view.row[at(i, j) + 1] > view.row[at(i, j)]) continue;
                    nearest = apart;
                    sky[p] = apparent[at(i, j)];
                }
            }
        }
    }
    return sky;
}

/// [K²] Variance of pixels' means, summed over the pixels, of the shares of the sun that their
/// samples find: in the part of a pixel that has n of them an edge leaves ΔK² s (1 − s) n^-3/2, as
/// one between two facets (variance_of_one()). Shares over the hours before have edges that moved:
/// each sample has a time of its own, and n^-2 is left.
double variance_by_sun(const View& view, const PixelSun& sun, double samples) {
    const bool past = !sun.past_share.empty();
    const std::vector<float>& share = past ? sun.past_share : sun.share;
    double sum = 0.0;
    for (std::size_t e = 0; e < sun.kelvins.size(); ++e) {
        const double weight = double{view.sighting[sun.sighting[e]].weight};
        const double s = std::clamp(double{share[e]}, 0.0, 1.0);
        const double of_one = std::pow(weight * double{sun.kelvins[e]}, 2) * s * (1.0 - s);
        const double n = std::max(1.0, weight * samples);
        sum += of_one / (n * (past ? n : std::sqrt(n)));
    }
    return sum;
}

}  // namespace

double sample_error(const Prepared& prepared, const Series& series, const FacetViews& views,
                    const Frame& frame, std::span<const float> temperature,
                    const LinearFacets& ground, const PixelSun& sun) {
    const auto band = std::find_if(series.bands.rbegin(), series.bands.rend(),
                                   [](const Band& b) { return b.to_um() > 3.0; });
    if (series.view.samples.empty() || band == series.bands.rend()) return 0.0;
    Appearance look{.facet = thermal_appearance(prepared.world.surfaces(), views,
                                                prepared.scene.materials, temperature, *band),
                    .sky = {}};
    without_textures(prepared.world.texture_levels, look);
    const std::vector<float> sky =
        sky_around(series.view, frame["apparent_temperature." + band->name].pixel);
    const double by_sun = variance_by_sun(series.view, sun, double(series.sampling.samples)) /
                          double(series.view.pixels());
    return std::hypot(sampling_error(series.view, look, {.warmer = ground.warmer, .sky = sky}),
                      std::sqrt(by_sun));
}

}  // namespace diurna
