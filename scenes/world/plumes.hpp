#pragma once

#include <Eigen/Core>

#include "render/rays/plume.hpp"
#include "scenes/input/read_plumes.hpp"

namespace diurna {

/// ground  the point of the ground at its place
Plume plume_at(const PlumeInput& input, const Eigen::Vector3d& ground);

}  // namespace diurna
