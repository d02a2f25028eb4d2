#pragma once

#include <functional>

#include "render/view/observer.hpp"
#include "terrain/facets.hpp"

namespace diurna {

/// How many pixels of a picture show facets of materials for which `counts` holds, if nothing stood
/// before them: solid angles of those that face the camera within its field of view. Known before a
/// ray is cast; for the estimate of a plan only.
///
/// - counts: (material)
double seen_pixels(const Observer& observer, const FacetSet& facets,
                   const std::function<bool(MaterialId)>& counts);

}  // namespace diurna
