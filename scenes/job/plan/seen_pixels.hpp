#pragma once

#include <functional>

#include "render/view/observer.hpp"
#include "terrain/facets.hpp"

namespace diurna {

/// Number of pixels of a picture with facets of materials for which `counts` holds, ignoring
/// occlusion: from solid angles of facets that face the camera within its field of view. Needs no
/// rays; only for the estimate of a plan.
///
/// - counts: (material)
double seen_pixels(const Observer& observer, const FacetSet& facets,
                   const std::function<bool(MaterialId)>& counts);

}  // namespace diurna
