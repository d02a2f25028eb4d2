#pragma once

#include <cstddef>
#include <string>

#include "render/view/observer.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// How much of an object a camera sees, if it looks there: of points spread evenly over the
/// object's surfaces that face the eye, as it sees their areas.
struct TargetSight {
    std::size_t facing = 0;  // such points
    std::size_t seen = 0;    // those that nothing else stands before
    std::string hidden_by;   // what stands before most of the others; "": nothing

    /// 0 to 1; 1 of an object without surfaces that face the eye.
    double share() const { return facing == 0 ? 1.0 : double(seen) / double(facing); }
};

/// By 256 rays, whose points depend on the object and its place alone. What lets a twentieth of the
/// sun's beam or more through (a net, a pane) hides nothing.
TargetSight target_sight(const World& world, const RayScene& rays, const Observer& observer,
                         const std::string& object);

/// A target counts as hidden below this share, and as seen well above the other.
inline constexpr double hidden_below = 0.1, seen_above = 0.5;

}  // namespace diurna
