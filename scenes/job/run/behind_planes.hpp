#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"
#include "render/picture/frame.hpp"
#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The truth planes "object_behind.BAND": at pixels whose centre is a net or a pane that transmits
/// a twentieth or more of the band's light (its mean transmittance; of all of them in sequence),
/// the ObjectId of the first other object behind, 0 the ground; −1 without one and at all other
/// pixels. Bands without such pixels have no plane.
std::vector<Plane> behind_planes(const View& view, const World& world, const RayScene& rays,
                                 const MaterialLibrary& materials, const Observer& observer,
                                 std::span<const Band> bands);

}  // namespace diurna
