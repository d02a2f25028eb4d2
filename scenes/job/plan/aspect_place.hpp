#pragma once

#include <string>

#include "render/view/observer.hpp"
#include "scenes/job/input/read_around.hpp"
#include "scenes/job/world/world.hpp"

namespace diurna {

/// The middle of the upright box around an object, as in labels [m].
Eigen::Vector3d middle_of(const World& world, const std::string& name, double heading_deg);

/// The observer at its position around an object, looking at its middle.
Observer placed_around(Observer observer, const Around& around, const World& world);

}  // namespace diurna
