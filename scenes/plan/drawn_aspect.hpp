#pragma once

#include <cstdint>
#include <string>

#include "render/view/observer.hpp"
#include "scenes/input/read_around.hpp"
#include "scenes/plan/eye_check.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// A camera about an object, and what was drawn for it; "": nothing.
struct DrawnAspect {
    Observer observer;
    std::string note;
};

/// The camera where its table `around` puts it; with `if_hidden = "draw_again"` and a target that
/// is hidden from there, or an eye below the ground, another one at the same range: 32 aspects are
/// drawn evenly round the object, from the 17th on with elevations between its own and 80 degrees.
/// The first that sees half of what faces it is taken, else the one that sees most.
///
/// - seed: the scene's; the draw depends on the observer's name and its place, too
/// - poses: where objects that go are
DrawnAspect drawn_aspect(const Observer& camera, const Around& around, const World& world,
                         const RayScene& rays, const EyeCheck& check, const MoverPoses& poses,
                         std::uint64_t seed);

}  // namespace diurna
