#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/objects/placed_mesh.hpp"

namespace diurna {

/// Where an object that rests on level ground touches it, in its own frame (right, front, up [m],
/// from the middle of its plan and its lowest point): the outermost vertices in eight directions of
/// those within 2 % of its height above its lowest. Of a vehicle these lie on its wheels or tracks.
/// At most eight, each once; none of an empty mesh.
std::vector<Eigen::Vector3d> contact_points(const MeshFile& mesh, const Placing& placing);

/// The least extent of points in plan [m], of four directions; 0 of none.
double least_width(const std::vector<Eigen::Vector3d>& points);

}  // namespace diurna
