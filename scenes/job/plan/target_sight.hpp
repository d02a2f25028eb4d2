#pragma once

#include <cstddef>
#include <string>

#include "render/view/observer.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Visible part of an object for a camera that looks at it: from points spread evenly over the
/// object's surfaces that face the eye, by projected area.
struct TargetSight {
    std::size_t facing = 0;  // such points
    std::size_t seen = 0;    // those without anything in front
    std::string hidden_by;   // the most frequent obstacle of the others; "": none

    /// 0 to 1; 1 for an object without surfaces that face the eye.
    double share() const { return facing == 0 ? 1.0 : double(seen) / double(facing); }
};

/// By 256 rays, whose points depend only on the object and its place. Surfaces that transmit a
/// twentieth of the sun's beam or more (a net, a pane) hide nothing.
TargetSight target_sight(const World& world, const RayScene& rays, const Observer& observer,
                         const std::string& object);

/// A target counts as hidden below the first share, and as clearly visible above the second.
inline constexpr double hidden_below = 0.1, seen_above = 0.5;

}  // namespace diurna
