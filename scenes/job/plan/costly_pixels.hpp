#pragma once

#include <span>

#include "render/rays/plume.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/world/world.hpp"

namespace diurna {

/// Shares of an observer's pixels, 0 to 1, mean over its poses (at most four are looked at), whose
/// rays take more than others. Without rays, ignoring occlusion; only for the estimate of a plan.
struct CostlyPixels {
    double smoke = 0.0;     // in front of or within a plume
    double textured = 0.0;  // of textured facets
};

/// - observer: whose pictures' size counts
CostlyPixels costly_pixels(const World& world, std::span<const Plume> plumes,
                           const ObserverInput& observer, const Sequence& sequence);

}  // namespace diurna
