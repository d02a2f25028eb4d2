#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// A place on a facet.
struct PlaceOnFacet {
    std::uint32_t facet;
    Eigen::Vector3f place;  // [m]
};

/// Unit normals at places on a mesh of ground, of the smooth surface that its vertices describe:
/// each corner of a facet has the mean normal, by area, of the facets that meet there, except those
/// beyond a crease of more than 26° (Gouraud 1971, Phong 1975); linear between the corners. Exact
/// on a plane; on a curved surface with edges h the error is O(h²), that of a triangle's own
/// normal O(h).
///
/// - ground: number of facets, the first ones, that are ground; places are on these
std::vector<Eigen::Vector3f> smooth_normals(const FacetSet& facets, std::size_t ground,
                                            std::span<const PlaceOnFacet> places);

}  // namespace diurna
