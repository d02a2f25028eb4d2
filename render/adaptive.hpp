#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/view.hpp"

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

/// Samples of each pixel that spend least in all on the tolerance.
///
/// With a pixel's samples independent, its error is σ/√n, σ their standard deviation in the worst
/// appearance. The mean square of all pixels is least for a given sum of samples with n in
/// proportion to σ (Neyman 1934), and is the tolerance's square where n = σ mean(σ) / tolerance².
/// Samples are stratified, so what comes out is better by what that brings. σ is the root of the
/// mean of the pixel's own variance and that of the 3 × 3 around it, as `from` samples tell a
/// variance badly and miss what is small.
///
/// returns  (pixel) from + 0, 16, 48, 112, 240 ..., whole ray packets, the nearest to n by ratio
std::vector<int> samples_wanted(const View& view, std::span<const Appearance> appearances,
                                const AdaptiveOptions& options);

/// cast_view() with `from` samples, then with more in the pixels that want them; a pixel's mean is
/// over all its samples. `view.samples` is not used. The same for any number of threads.
///
/// Bias: samples of the first round count whether or not more follow. What covers a share p of a
/// pixel and is missed by all of `from` independent samples, (1 − p)^from, gets no second chance
/// there, its neighbours' variance aside: it comes out too faint by at most 0.02 of its contrast
/// for 16 (at p = 1/17), 0.08 for 4; stratified samples miss less. The error of `from` samples
/// alone would be three times that (tests/adaptive_test.cpp).
View cast_adaptive_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
                        std::span<const Appearance> appearances, const AdaptiveOptions& options,
                        const ViewOptions& view = {});

/// Two views of one observer as one, each pixel by the samples it has of either. Targets of both
/// are kept, those of `more` behind those of `view`.
///
/// samples, more_samples  (pixel) how many of each; a pixel of none in `more` is as in `view`
void add_view(View& view, std::span<const int> samples, const View& more,
              std::span<const int> more_samples);

}  // namespace diurna
