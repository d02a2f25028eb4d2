#pragma once

#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// What is behind panes and nets at pixels' centres, straight on: of every pixel whose centre is a
/// facet that lets light through, the first other object behind it, the ground (0) among them; −1
/// where there is none, where what lies before it lets pass less than `least`
/// together, and at all other pixels.
///
/// - facets: as the rays and View::centre number them
/// - passed: (material) share that goes on behind it; 0: opaque
/// - returns (pixel) numbers of objects; empty where no centre is such a facet
std::vector<int> seen_through(const View& view, const RayScene& rays, const FacetSet& facets,
                              const Observer& observer, std::span<const double> passed,
                              double least = 0.05);

}  // namespace diurna
