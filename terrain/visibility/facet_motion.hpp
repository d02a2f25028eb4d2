#pragma once

#include <Eigen/Core>
#include <vector>

namespace diurna {

/// Where a scene's vertices are at the times 0 and 1 of rays; between them each goes straight on at
/// an even speed. The facets' own are where they are at 0.5.
struct FacetMotion {
    std::vector<Eigen::Vector3f> before, after;  // (vertex) [m]
};

}  // namespace diurna
