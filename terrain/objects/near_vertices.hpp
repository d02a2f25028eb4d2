#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// Which vertices replace close ones: for each vertex the nearest of the earlier vertices that are
/// not replaced, within `tolerance` and a quarter of the shortest edge at either.
///
/// - shortest: (vertex) the shortest edge at it; negative: it is not replaced and replaces none
/// returns  (vertex) the vertex that replaces it; itself if not replaced
std::vector<std::uint32_t> near_vertices(std::span<const Eigen::Vector3d> vertex,
                                         std::span<const double> shortest, double tolerance);

}  // namespace diurna
