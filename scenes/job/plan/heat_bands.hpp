#pragma once

#include <vector>

#include "materials/radiation/band.hpp"
#include "scenes/job/input/scene.hpp"

namespace diurna {

/// The observer's bands that reach beyond 3 µm, whose pictures show temperatures.
std::vector<Band> heat_bands(const Scene& scene, const ObserverInput& observer);

}  // namespace diurna
