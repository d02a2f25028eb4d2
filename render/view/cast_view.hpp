#pragma once

#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Casts `samples` rays a pixel, one in each cell of a grid over the pixel at a place that depends
/// on (seed, pixel, sample) alone, and one through its centre. The same for any number of threads.
/// Averaging ranges over a pixel is the only loss.
View cast_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options = {});

}  // namespace diurna
