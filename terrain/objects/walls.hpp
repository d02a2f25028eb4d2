#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "terrain/ground/rings.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// Upright walls around a plan, from the ground to a level top. The lowest row of facets ends on
/// the ground's own vertices, so that none is half buried and none is above the ground; rows above
/// it grow to the height of `side`.
struct WallsSpec {
    Ring ring;                            // counterclockwise; east, north [m]
    double bottom = 0.0;                  // [m] used if the foot is not known
    double top = 5.0;                     // [m]
    double side = 3.0;                    // of the facets' lattice, at most [m]
    double lowest_row = 3.0;              // its height, about, if the foot is known [m]
    std::vector<Eigen::Vector3d> foot{};  // ground's border around the plan, counterclockwise
    std::vector<MaterialId> material{};   // (side of the plan), from its corner to the next
};

/// Whether a border follows a plan within a metre, corner by corner.
bool goes_round(const std::vector<Eigen::Vector3d>& border, const Ring& ring);

/// Appends them to a mesh, with vertices shared between neighbours. Without a foot, or if it does
/// not follow the plan, all walls start at `bottom`; returns whether the foot was used.
bool append_walls(const WallsSpec& spec, ObjectMesh& mesh);

/// The same mesh with one vertex for each place.
ObjectMesh welded(const ObjectMesh& mesh);

}  // namespace diurna
