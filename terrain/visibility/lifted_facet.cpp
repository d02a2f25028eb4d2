#include "terrain/visibility/lifted_facet.hpp"

#include <Eigen/Geometry>

namespace diurna {

std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents(const Eigen::Vector3d& n) {
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
    return {{1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()},
            {b, sign + n.y() * n.y() * a, -n.y()}};
}

LiftedFacet::LiftedFacet(const FacetSet& facets, std::size_t facet)
    : LiftedFacet(facets, facet, Eigen::Isometry3d::Identity()) {}

LiftedFacet::LiftedFacet(const FacetSet& facets, std::size_t facet, const Eigen::Isometry3d& pose)
    : normal(pose.linear() * facets.normal[facet].cast<double>()) {
    const auto& index = facets.corner[facet];
    corner = pose * facets.vertex[index[0]].cast<double>();
    to_b = pose * facets.vertex[index[1]].cast<double>() - corner;
    to_c = pose * facets.vertex[index[2]].cast<double>() - corner;
    const double coarse =
        corner.cwiseAbs().maxCoeff() + to_b.cwiseAbs().maxCoeff() + to_c.cwiseAbs().maxCoeff();
    corner += normal * (coarse * 4e-7);
}

}  // namespace diurna
