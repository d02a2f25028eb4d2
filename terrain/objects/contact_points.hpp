#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "terrain/objects/placed_mesh.hpp"

namespace diurna {

/// Points at which an object on level ground touches it, in its own frame (right, front, up [m],
/// from the middle of its plan and its lowest point): among the vertices within 2 % of its height
/// above its lowest point, the outermost in eight directions. For a vehicle these are on its wheels
/// or tracks. At most eight, each once; none for an empty mesh.
std::vector<Eigen::Vector3d> contact_points(const MeshFile& mesh, const Placing& placing);

/// Points at which the object would touch level ground after a rotation `turn`, found among its
/// vertices in the same way; in its own frame, before the rotation. Of an object that lies on its
/// roof these are on the roof.
std::vector<Eigen::Vector3d> contact_points(const MeshFile& mesh, const Placing& placing,
                                            const Eigen::Matrix3d& turn);

/// The smallest extent of points in plan [m], over four directions; 0 without points.
double least_width(const std::vector<Eigen::Vector3d>& points);

}  // namespace diurna
