#pragma once

#include <Eigen/Core>

#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// A box with its base centre at `base`, its front towards `heading_deg` (clockwise from north);
/// faces are divided into triangles with edges of at most `largest_edge` [m]. The front, the other
/// walls and the roof have their own materials; no floor (it stands in the ground by `sunk`
/// metres).
struct BoxSpec {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();
    double width = 10.0, depth = 10.0, height = 5.0;  // across, along the heading, up [m]
    double heading_deg = 180.0;
    double sunk = 2.0;
    double largest_edge = 3.0;
    MaterialId wall{}, front{}, roof{};
};
ObjectMesh box(const BoxSpec& spec);

}  // namespace diurna
