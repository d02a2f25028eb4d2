#pragma once

#include <Eigen/Core>

#include "render/rays/plume.hpp"
#include "scenes/job/input/read_plumes.hpp"

namespace diurna {

/// - foot: its middle
Plume plume_at(const PlumeInput& input, const Eigen::Vector3d& foot);

}  // namespace diurna
