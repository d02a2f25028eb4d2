#pragma once

#include <Eigen/Core>
#include <optional>

#include "scenes/world/world.hpp"

namespace diurna {

/// The upright box around an object that faces as it does.
struct UprightBox {
    Eigen::Vector3d middle;        // east, north, up [m]
    double length, width, height;  // along its heading, across, upright [m]
};

/// An object's facets as a set of their own, in its place, copies too; without corners in common.
FacetSet object_facets(const World& world, ObjectId id);

/// None where the object has no facet.
std::optional<UprightBox> upright_box(const FacetSet& facets, ObjectId id, double heading_deg);

}  // namespace diurna
