#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// A box with its base centre at `base`, its front towards `heading_deg` (clockwise from north);
/// faces are divided into triangles with edges of at most `largest_edge` [m]. The front, the other
/// walls and the roof have their own materials; there is no floor.
struct BoxSpec {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();
    double width = 10.0, depth = 10.0, height = 5.0;  // across, along the heading, up [m]
    double heading_deg = 180.0;
    double sunk = 2.0;  // depth of walls below the base if the foot is not known [m]
    double largest_edge = 3.0;
    double lowest_row = 0.5;              // height of the facets next to the ground, about [m]
    std::vector<Eigen::Vector3d> foot{};  // ground's border around the plan, counterclockwise
    MaterialId wall{}, front{}, roof{};
};
ObjectMesh box(const BoxSpec& spec);

/// Corners of its plan, counterclockwise from back left (seen along the heading); east, north [m].
/// [m].
Ring plan_of(const BoxSpec& spec);

}  // namespace diurna
