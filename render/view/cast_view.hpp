#pragma once

#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Casts `samples` rays a pixel, one in each cell of a grid over the pixel at a position that
/// depends only on (seed, pixel, sample), and one through its centre. The same for any number of
/// threads. The only loss is the averaging of ranges over a pixel.
View cast_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options = {});

}  // namespace diurna
