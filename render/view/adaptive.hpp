#pragma once

#include <cstdint>
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

/// Samples where pixels need them: at least `from` a pixel, at most `to`.
struct AdaptiveOptions {
    int from = 16;
    int to = 256;
    double tolerance = 0.1;  // [K] root mean square error of the picture that is aimed at
};

/// What facets look like, roughly, at one of the instants to be pictured: enough to tell which
/// pixels are hard. Kelvins, or what counts as much.
struct Appearance {
    std::vector<float> facet;  // (facet)
    float sky = 250.0f;
};

/// Facets as a band sees them, roughly: ε T + (1 − ε) of a sky of 250 K and of surroundings as warm
/// as the facet, by its sky view. ε is the mean over the band.
std::vector<float> thermal_appearance(const FacetSet& facets, const FacetViews& views,
                                      const MaterialLibrary& materials,
                                      std::span<const float> temperature, const Band& band);

/// Samples of each pixel that spend least in all on the tolerance.
///
/// Of n samples in a grid of cells only those cells err that a border between facets goes through:
/// with K facets in the pixel some √(K − 1) √n of them. So the error of their mean is about
/// A n^-3/2, A = σ² √(K − 1), σ the samples' standard deviation in the worst appearance. The sum of
/// these over the picture is least for a given sum of samples with n in proportion to A^2/5 (as
/// Neyman 1934 for n^-1), and its mean is the tolerance's square with n = A^2/5 (mean A^2/5 /
/// tolerance²)^2/3. A is the mean of the pixel's own and of that of the 3 × 3 around it, as `from`
/// samples tell a variance badly and miss what is small.
///
/// returns  (pixel) from + 0, 16, 48, 112, 240 ..., whole ray packets, the nearest to n by ratio
std::vector<int> samples_wanted(const View& view, std::span<const Appearance> appearances,
                                const AdaptiveOptions& options);

/// cast_view() with `from` samples, then with more in the pixels that want them. `view.samples` is
/// not used. A pixel's mean weighs its two rounds as n^3/2, by the inverse of their errors. The
/// same for any number of threads.
///
/// Bias: what covers a share p of a pixel and is missed by all of `from` independent samples, by
/// chance (1 − p)^from, gets no second chance but for its neighbours' spread: it comes out too
/// faint by at most 0.02 of its contrast for 16 (at p = 1/17), 0.08 for 4. The error of `from`
/// samples alone would be three times that (tests/render/adaptive_test.cpp).
View cast_adaptive_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
                        std::span<const Appearance> appearances, const AdaptiveOptions& options,
                        const ViewOptions& view = {});

}  // namespace diurna
