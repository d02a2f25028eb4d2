#pragma once

#include <algorithm>
#include <optional>

#include "render/view/adaptive.hpp"
#include "scenes/job/input/scene.hpp"

namespace diurna {

/// Adaptive samples of an observer's pixels by the whole picture; nothing: `samples` each.
/// If nothing is said of it, by what is seen in 8-12 um, so that a band alone has the samples that
/// it has among others. Not where each pixel's surfaces are listed: more samples see more than the
/// list holds. Sixteen alone leave 0.2 to 0.3 K rms in a close view of vehicles and nets.
inline std::optional<AdaptiveOptions> adaptive_samples(const ObserverInput& observer) {
    if (observer.adaptive) return observer.adaptive;
    if (observer.samples < 4 || observer.surfaces > 0) return std::nullopt;
    return AdaptiveOptions{
        .from = observer.samples, .to = std::max(observer.samples, 256), .tolerance = 0.02};
}

/// The same of pixels whose rays are followed (render/rays/follow_rays.hpp).
inline std::optional<AdaptiveOptions> adaptive_secondary(const Scene& scene,
                                                         const ObserverInput& observer) {
    std::optional<AdaptiveOptions> options = adaptive_samples(observer);
    if (!options || scene.exact) return std::nullopt;
    // Of each such pixel by itself, not of the picture: most of them would take all they may.
    if (!observer.adaptive) options->tolerance = 0.05;
    return options;
}

}  // namespace diurna
