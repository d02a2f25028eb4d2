#pragma once

#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Objects behind panes and nets at pixels' centres, on the line of sight: for every pixel whose
/// centre is a transparent facet, the first other object behind it, the ground (0) included; −1
/// without one, if everything in front of it transmits less than `least` in total, and at all other
/// pixels.
///
/// - facets: as the rays and View::centre number them
/// - passed: (material) transmitted share; 0: opaque
/// - returns (pixel) numbers of objects; empty where no centre is such a facet
std::vector<int> seen_through(const View& view, const RayScene& rays, const FacetSet& facets,
                              const Observer& observer, std::span<const double> passed,
                              double least = 0.05);

}  // namespace diurna
