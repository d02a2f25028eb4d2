#pragma once

#include "materials/base/document.hpp"
#include "scenes/input/scene.hpp"

namespace diurna {

/// One table [[observer]]; the scene's bands and cubes are known already.
ObserverInput read_observer(const Section& section, const Scene& scene);

}  // namespace diurna
