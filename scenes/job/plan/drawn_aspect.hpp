#pragma once

#include <cstdint>
#include <string>

#include "render/view/observer.hpp"
#include "scenes/job/input/read_around.hpp"
#include "scenes/job/plan/eye_check.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// A camera around an object, and a note on its random aspect; "": none.
struct DrawnAspect {
    Observer observer;
    std::string note;
};

/// The camera at the position of its table `around`; with `if_hidden = "draw_again"` and a target
/// that is hidden from there, or an eye below the ground, another one at the same range: 32 aspects
/// are drawn evenly around the object, from the 17th on with elevations between its own and 80
/// degrees. The first that sees half of the facing surface is used, else the one that sees most.
///
/// - seed: the scene's; the draw depends on the observer's name and its place, too
/// - poses: of moving objects
DrawnAspect drawn_aspect(const Observer& camera, const Around& around, const World& world,
                         const RayScene& rays, const EyeCheck& check, const MoverPoses& poses,
                         std::uint64_t seed);

}  // namespace diurna
