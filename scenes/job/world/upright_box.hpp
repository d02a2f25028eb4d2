#pragma once

#include <Eigen/Core>
#include <optional>

#include "scenes/job/world/world.hpp"

namespace diurna {

/// The upright box around an object, along its heading.
struct UprightBox {
    Eigen::Vector3d middle;        // east, north, up [m]
    double length, width, height;  // [m] along its heading, across, vertical
};

/// An object's facets as a separate set, at its place, copies too; without common corners.
FacetSet object_facets(const World& world, ObjectId id);

/// None if the object has no facet.
std::optional<UprightBox> upright_box(const FacetSet& facets, ObjectId id, double heading_deg);

}  // namespace diurna
