#pragma once

#include <Eigen/Core>
#include <vector>

namespace diurna {

/// Positions of a scene's vertices at ray times 0 and 1; between them each moves straight at
/// constant speed. The positions in the FacetSet are those at 0.5.
struct FacetMotion {
    std::vector<Eigen::Vector3f> before, after;  // (vertex) [m]
};

}  // namespace diurna
