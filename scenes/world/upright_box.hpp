#pragma once

#include <Eigen/Core>
#include <optional>

#include "terrain/facets.hpp"

namespace diurna {

/// The upright box around an object that faces as it does.
struct UprightBox {
    Eigen::Vector3d middle;        // east, north, up [m]
    double length, width, height;  // along its heading, across, upright [m]
};

/// None where the object has no facet.
std::optional<UprightBox> upright_box(const FacetSet& facets, ObjectId id, double heading_deg);

}  // namespace diurna
