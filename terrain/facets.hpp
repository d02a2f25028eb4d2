#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

enum class FacetId : std::uint32_t {};
inline constexpr FacetId no_facet{0xFFFFFFFFu};
enum class ObjectId : std::uint16_t {};  // 0 is the ground

constexpr std::size_t index(FacetId id) { return static_cast<std::size_t>(id); }
constexpr std::size_t index(MaterialId id) { return static_cast<std::size_t>(id); }

/// Every triangle of the scene, one array per property, all of length size(). Positions
/// are east, north, up [m] in the Site's frame. Used by visibility, heat balance and
/// pictures.
struct FacetSet {
    std::vector<Eigen::Vector3f> vertex;               // shared by neighbouring facets
    std::vector<std::array<std::uint32_t, 3>> corner;  // (facet) counterclockwise from outside
    std::vector<Eigen::Vector3f> centroid;
    std::vector<Eigen::Vector3f> normal;  // unit, outward
    std::vector<float> area;              // [m²]
    std::vector<MaterialId> material;
    std::vector<ObjectId> object;

    std::size_t size() const { return area.size(); }
};

/// Appends triangles as facets of one object. Facets follow a space-filling curve (Morton order of
/// the centroids in plan), so that neighbours are close in memory. Triangles without area are
/// skipped, and so are slivers thinner than a float resolves at their position (1 mm at 10 km):
/// their normals would be noise. Throws InputError if a vertex is not finite or farther than 100 km
/// from the origin.
void append_facets(FacetSet& facets, std::span<const Eigen::Vector3d> vertex,
                   std::span<const std::array<std::uint32_t, 3>> triangle,
                   std::span<const MaterialId> material, ObjectId object);
void append_facets(FacetSet& facets, const ObjectMesh& mesh, ObjectId object);
/// The same for many objects' triangles, in ascending order of object: same result as one call per
/// object, in a time that does not depend on the number of objects.
///
/// - object: (triangle)
void append_facets(FacetSet& facets, std::span<const Eigen::Vector3d> vertex,
                   std::span<const std::array<std::uint32_t, 3>> triangle,
                   std::span<const MaterialId> material, std::span<const ObjectId> object);

}  // namespace diurna
