#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// A building on a plan of any simple ring (east, north; either sense of turning): upright walls
/// from the ground, or from `bottom` where that is not known, to `top` [m], divided into triangles
/// with edges of about `largest_edge`, and a flat roof. Throws InputError for less than three
/// corners and a ring that crosses itself.
struct PrismSpec {
    Ring ring;
    double bottom = 0.0, top = 5.0;
    double largest_edge = 3.0;
    std::vector<Eigen::Vector3d> foot{};  // the ground's border round the plan, counterclockwise
    MaterialId wall{}, roof{};
    std::string where = "building";  // in the file, for what is thrown
};
ObjectMesh prism(const PrismSpec& spec);

}  // namespace diurna
