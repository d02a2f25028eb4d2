#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"
#include "render/picture/frame.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The truth planes "object_behind.BAND": at pixels whose centre is a net or a pane that lets a
/// twentieth or more of the band's light pass (its mean transmittance; of all such on the way), the
/// ObjectId of the first thing behind of another object, 0 the ground; −1 where there is none and
/// at all other pixels. Bands in which no pixel's centre is such have no plane.
std::vector<Plane> behind_planes(const View& view, const World& world, const RayScene& rays,
                                 const MaterialLibrary& materials, const Observer& observer,
                                 std::span<const Band> bands);

}  // namespace diurna
