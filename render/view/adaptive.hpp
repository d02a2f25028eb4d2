#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// Adaptive sampling: at least `from` samples a pixel, at most `to`.
struct AdaptiveOptions {
    int from = 16;
    int to = 256;
    double tolerance = 0.1;  // [K] target for the root mean square error of the picture
};

/// Approximate appearance of facets at one of the instants to be rendered, to find the pixels that
/// need more samples. Kelvins, or an equivalent.
struct Appearance {
    std::vector<float> facet;  // (facet)
    float sky = 250.0f;
};

/// Approximate appearance of facets in a band: ε T + (1 − ε) of a sky of 250 K and of surroundings
/// at the facet's temperature, by its sky view. ε is the mean over the band.
std::vector<float> thermal_appearance(const FacetSet& facets, const FacetViews& views,
                                      const MaterialLibrary& materials,
                                      std::span<const float> temperature, const Band& band);

/// (pixel) [K²] Variance of the mean of one sample, A: the mean of n has A n^-3/2.
///
/// Of n samples in a grid of cells only cells crossed by a border between facets have an error:
/// with K facets in the pixel about √(K − 1) √n of them. So the variance of their mean is about A
/// n^-3/2, A = σ² √(K − 1), σ the samples' standard deviation in the worst appearance. A is the
/// mean of the pixel's own and of that of the 3 × 3 around it, as few samples estimate a variance
/// poorly and miss small things.
///
/// - view: of `samples` a pixel
std::vector<double> variance_of_one(const View& view, std::span<const Appearance> appearances,
                                    int samples);

/// What pixels see beyond an Appearance.
struct SeenInPixels {
    std::span<const float> warmer = {};  // (sighting) [K] than its facet's appearance; empty: 0
    std::span<const float> sky = {};     // (pixel) [K] in place of Appearance::sky; empty: as there
};

/// [K] Expected root mean square, over the pixels, of what their number of samples leaves of their
/// mean appearance; 0 where View::samples is empty.
double sampling_error(const View& view, const Appearance& appearance,
                      const SeenInPixels& seen = {});

/// Samples of each pixel that reach the tolerance at the lowest total cost: for a given total of
/// samples the sum of A n^-3/2 over the picture is least with n in proportion to A^2/5 (as Neyman
/// 1934 for n^-1), and its mean is the square of the tolerance with n = A^2/5 (mean A^2/5 /
/// tolerance²)^2/3.
///
/// - of_one: (pixel) A [K²]
/// returns  (pixel) from + 0, 16, 48, 112, 240 ..., whole ray packets, the nearest to n by ratio
std::vector<int> samples_wanted(std::span<const double> of_one, const AdaptiveOptions& options);

/// cast_view() with `from` samples, then with more in the pixels that need them. `view.samples` is
/// not used; `first`, if given, is the view with `from` samples. A pixel's mean weights its two
/// rounds by n^3/2, the inverse of their errors. Sets View::samples. The same for any number of
/// threads.
///
/// Bias: an object with a share p of a pixel that all `from` independent samples miss, with
/// probability (1 − p)^from, is only sampled again if its neighbours vary: it appears too faint by
/// at most 0.02 of its contrast for 16 (at p = 1/17), 0.08 for 4. The error of `from` samples alone
/// would be three times that (tests/render/adaptive_test.cpp).
View cast_adaptive_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
                        std::span<const Appearance> appearances, const AdaptiveOptions& options,
                        const ViewOptions& view = {}, std::optional<View> first = {});

}  // namespace diurna
