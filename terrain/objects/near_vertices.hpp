#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace diurna {

/// Which vertices take the place of others that lie close: for each the nearest of those before it
/// that keep their place, within `tolerance` and a quarter of the shortest edge at either.
///
/// - shortest: (vertex) the shortest edge at it; negative: it keeps its place and nobody takes it
/// returns  (vertex) the vertex in whose place it goes; itself if in none
std::vector<std::uint32_t> near_vertices(std::span<const Eigen::Vector3d> vertex,
                                         std::span<const double> shortest, double tolerance);

}  // namespace diurna
