#pragma once

#include "render/rays/hops.hpp"
#include "render/rays/walk.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Follows the rays of every pixel of `view` that sees a material that needs_rays() or comes near
/// a plume, `samples` a pixel, and takes these pixels' sightings out of `view`:
/// what they see is in the hops instead. Empty, and nothing cast, where there is no such pixel.
Hops follow_rays(View& view, const HopScene& scene, const Observer& observer,
                 const ViewOptions& options = {});

}  // namespace diurna
