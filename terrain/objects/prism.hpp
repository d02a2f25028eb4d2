#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// A building on a plan of any simple ring (east, north; either order): upright walls from the
/// ground, or from `bottom` if that is not known, to `top` [m], divided into triangles with edges
/// of about `largest_edge`, and a flat roof. Courtyards are holes of the plan, with walls that face
/// into them. Throws InputError for less than three corners, a ring that crosses itself, and a hole
/// that is not inside.
struct PrismSpec {
    Ring ring;
    std::vector<Ring> hole{};  // courtyards; either order
    double bottom = 0.0, top = 5.0;
    double largest_edge = 3.0;
    std::vector<Eigen::Vector3d> foot{};  // ground's border around the plan, counterclockwise
    /// (hole) the ground's border in the courtyard, clockwise; empty: as without a foot
    std::vector<std::vector<Eigen::Vector3d>> hole_foot{};
    MaterialId wall{}, roof{};
    std::string where = "building";  // place in the file, for exceptions
};
ObjectMesh prism(const PrismSpec& spec);

/// A hole's corners as those of a courtyard, clockwise; empty if it is smaller than 0.1 m².
Ring court_of(const Ring& hole);

}  // namespace diurna
