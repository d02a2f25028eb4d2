#pragma once

#include <Eigen/Core>
#include <vector>

namespace diurna {

/// Directions spread evenly over the sphere: the corners of an icosahedron, with its edges halved
/// until there are `count`: 12, 42, 162, 642, ...; unit vectors, one of them upward. In a fixed
/// order.
///
/// With 42 or more, each represents 4π over their number within 12 % of solid angle.
std::vector<Eigen::Vector3d> even_directions(int count);

}  // namespace diurna
