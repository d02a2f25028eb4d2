#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "terrain/facets.hpp"

namespace diurna {

/// Two unit vectors at right angles to `normal` and to each other (Duff et al. 2017).
std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents(const Eigen::Vector3d& normal);

/// A facet's corner and two edges, moved off it by a few units in the last place of its
/// coordinates, so that no ray meets the facet it starts from.
struct LiftedFacet {
    Eigen::Vector3d normal, corner, to_b, to_c;

    LiftedFacet(const FacetSet& facets, std::size_t facet);
    /// At a copy's place.
    LiftedFacet(const FacetSet& facets, std::size_t facet, const Eigen::Isometry3d& pose);
    /// u, v uniform in the unit square give points uniform on the triangle.
    Eigen::Vector3f at(double u, double v) const {
        const double root = std::sqrt(u);
        return (corner + (1.0 - root) * to_b + root * v * to_c).cast<float>();
    }
};

}  // namespace diurna
