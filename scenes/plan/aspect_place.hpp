#pragma once

#include "render/view/observer.hpp"
#include "scenes/input/read_around.hpp"
#include "scenes/world/world.hpp"

namespace diurna {

/// The observer at its place about an object, looking at its middle.
Observer placed_around(Observer observer, const Around& around, const World& world);

}  // namespace diurna
